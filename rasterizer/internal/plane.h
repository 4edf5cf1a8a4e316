#pragma once

// Sums Σ k_i E_i of a triangle's edge functions, collected into one line A U + (B V + C):
// numerators and denominators of values are evaluated from these, two operations a sample.
//
// Error, u = 2^-53, S_i of edge_functions.h. Collecting costs a product and two sums for each
// coefficient, and C one more for T; evaluating a product and one or two sums; with the rounding
// that a coefficient of E_i has itself that is 6u of the term of U and 7u of the others. So
//
//   |δ Σ k_i E_i| <= 7u Σ |k_i| S_i   to first order,   <= Σ |k_i| plane_band_i,
//
// plane_band_i = 8u S_i and what U and V are off by; 10u S_i where coefficients are off by 3u
// (weights.h). Multiplied by a `scale` and moved by an `offset`, as depths are, it has two more
// roundings of the sum and three of the offset.
//
// An evaluated line is monotone along a row and along a column, as every rounding is: over a
// rectangle of samples it is least and greatest at corners, exactly.

#include <array>

#include "rasterizer/internal/edge_functions.h"
#include "rasterizer/internal/sample_frame.h"

namespace rastercheck::rasterizer {

struct Plane {
  double a = 0;
  double b = 0;
  double c = 0;  ///< times T

  /// B V + C, the part that is the same along a row.
  double row(const SampleFrame& frame, double v) const { return b * frame.v.at(v) + c; }
};

/// offset + scale Σ k_i E_i, in the order of operations that all who collect it have in common.
/// Where it is 0 it is not −0.
inline Plane plane_of(const EdgeFunctions& edges, const std::array<double, 3>& k,
                      const SampleFrame& frame, double scale = 1, double offset = 0) {
  const auto sum = [&k](double first, double second, double third) {
    return (k[0] * first + k[1] * second) + k[2] * third;
  };
  return {sum(edges[0].a.value, edges[1].a.value, edges[2].a.value) * scale,
          sum(edges[0].b.value, edges[1].b.value, edges[2].b.value) * scale,
          sum(edges[0].c.value, edges[1].c.value, edges[2].c.value) * frame.t * scale + offset};
}

/// A row of a plane's samples, as the kernels take it.
struct PlaneRow {
  double a = 0;
  double row = 0;
};

inline PlaneRow plane_row(const Plane& plane, const SampleFrame& frame, double v) {
  return {plane.a, plane.row(frame, v)};
}

}  // namespace rastercheck::rasterizer
