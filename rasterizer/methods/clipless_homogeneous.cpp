// clipless-homogeneous: every parameter a linear function of homogeneous coordinates, no clipping
// (seed 000, A 6.7–A 6.9; Olano and Greer, Triangle Scan Conversion using 2D Homogeneous
// Coordinates, its reference 8).
//
// The mathematics. A parameter r that is linear on the triangle before the perspective division is
// a linear function of the homogeneous window coordinates of its points, (X, Y, w) = (u w, v w, w):
//
//   r = a X + b Y + c w                                                        (seed 000, A 6.7)
//
// with (a, b, c) M = (r_1, r_2, r_3), M = columns (X_i, Y_i, w_i). So r/w = a u + b v + c (A 6.8),
// and for the parameter that is 1 everywhere 1/w = a_1 u + b_1 v + c_1 (A 6.9). With the rows
//
//   A_i = Y_j w_k − Y_k w_j,   B_i = w_j X_k − w_k X_j,   C_i = X_j Y_k − X_k Y_j
//
// of the adjugate, (i, j, k) in cyclic order, (a, b, c) = Σ r_i (A_i, B_i, C_i)/det M, and 1's is
// the sum of the rows. The quotient needs no det M:
//
//   r = (a u + b v + c) / (a_1 u + b_1 v + c_1).
//
// A row is also the equation of an edge. No w_i is divided by, nothing is clipped, and a vertex
// with w <= 0 is no different: that is what Olano and Greer have the coordinates homogeneous for. A
// further parameter costs one more plane for the triangle and one more evaluation and division.
//
// Error (internal/point_drawing.h), u = 2^-53. A_i and B_i are off by 5 u and C_i by 8 u of their
// terms' magnitudes (3 u for each of X and Y). A parameter's a, b and c have a product and two sums
// more for each term, 3 u, and the place another product and two sums (c one): N is off by at most
// 12 u max|r_i| Σ|E|_i, and D, with no product by r_i, by 11 u Σ|E|_i. One more each for what is of
// second order: n = 13, d = 12. Nothing overflows or underflows: N is below 2^648 and its terms are
// multiples of 2^-751.
//
// The formula is HomogeneousPlanes of internal/homogeneous_planes.h.
//
// What it does not do: promise anything where K is large, as for slivers and towards the horizon.
//
// Operations for two attributes, and the divisions among them:
//   clipless-homogeneous: 14 (2) per pixel, 63 per polygon

#include "rasterizer/methods/internal/homogeneous_planes.h"
#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

Promise promise(const State& /*state*/, const Mesh& /*mesh*/, const TargetSize& /*size*/) {
  return {.smooth = point_bound(13, 12, kDoubleRoundoff)};
}

const MethodRegistration kRegistration(
    {.name = "clipless-homogeneous",
     .source = "seed 000 A 6.7–A 6.9; Olano and Greer",
     .fails = "where the weights cancel: slivers, tiny triangles, towards the horizon",
     .draw = &draw_by_formula<HomogeneousPlanes, double>,
     .promise = &promise,
     .operations = &count_formula<HomogeneousPlanes>});

}  // namespace
}  // namespace rastercheck::rasterizer
