// clipless-homogeneous: every parameter is a linear function of homogeneous coordinates, without
// clipping (Appendix 5, A 6.7–A 6.9; Olano and Greer, Triangle Scan Conversion using 2D Homogeneous
// Coordinates, its reference 8).
//
// The mathematics. A parameter r that is linear on the triangle before the perspective division is
// a linear function of the homogeneous window coordinates of its points, (X, Y, w) = (u w, v w, w):
//
//   r = a X + b Y + c w                                                       (Appendix 5, A 6.7)
//
// with (a, b, c) M = (r_1, r_2, r_3), M = columns (X_i, Y_i, w_i). So r/w = a u + b v + c (A 6.8),
// and the parameter that is 1 everywhere gives 1/w = a_1 u + b_1 v + c_1 (A 6.9). With the rows
//
//   A_i = Y_j w_k − Y_k w_j,   B_i = w_j X_k − w_k X_j,   C_i = X_j Y_k − X_k Y_j
//
// of the adjugate, (i, j, k) in cyclic order, (a, b, c) = Σ r_i (A_i, B_i, C_i)/det M; for the
// parameter 1, (a_1, b_1, c_1) is the sum of the rows over det M. The quotient needs no det M:
//
//   r = (a u + b v + c) / (a_1 u + b_1 v + c_1).
//
// Each row is also the equation of an edge. The method neither divides by any w_i nor clips, and
// vertices with w <= 0 need no special case; this is why Olano and Greer use homogeneous
// coordinates. Each further parameter costs one more plane per triangle, and one more evaluation
// and division per place.
//
// Error (internal/point_drawing.h), u = 2^-53. A_i and B_i have errors of 5 u and C_i of 8 u times
// their terms' magnitudes (3 u for each of X and Y). Coefficients a, b and c add a product and two
// sums, 3 u. Evaluating the plane adds a product and two sums (for c only one sum). So the
// numerator N has an error of at most 12 u max|r_i| Σ|E|_i. The denominator D has no product by
// r_i, and an error of at most 11 u Σ|E|_i. Adding 1 to each for second order gives n = 13, d = 12.
// No overflow or underflow occurs: N is below 2^648 and its terms are multiples of 2^-751.
//
// The formula is implemented by HomogeneousPlanes in internal/homogeneous_planes.h.
//
// The method promises nothing where K is large, for example for slivers or towards the horizon.
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
     .source = "Appendix 5, A 6.7–A 6.9; Olano & Greer 1997",
     .fails = "where the weights cancel: slivers, tiny triangles, towards the horizon",
     .draw = &draw_by_formula<HomogeneousPlanes, double>,
     .promise = &promise,
     .operations = &count_formula<HomogeneousPlanes>});

}  // namespace
}  // namespace rastercheck::rasterizer
