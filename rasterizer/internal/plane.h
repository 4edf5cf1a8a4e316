#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The sums Σ k_i E_i of a triangle's edge functions, each collected into one line A U + (B V + C).
// The numerators and denominators of values are evaluated from these lines, with two operations per
// sample.
//
// Error, with u = 2^-53 and S_i of edge_functions.h. Collecting costs a product and two sums for
// each coefficient, and for C also a product with T. Evaluating costs a product and one or two
// sums. With the rounding of each coefficient of E_i, that is 6u of the term of U and 7u of the
// other terms. So
//
//   |δ Σ k_i E_i| <= 7u Σ |k_i| S_i   to first order,   <= Σ |k_i| plane_band_i,
//
// where plane_band_i is 8u S_i plus the errors of U and V, or 10u S_i if coefficients have errors
// of 3u (weights.h). If the line is multiplied by a `scale` and moved by an `offset`, as depths
// are, it has two more roundings of the sum and three of the offset.
//
// An evaluated line is monotone along a row and along a column, because every rounding is monotone.
// So over a rectangle of samples, its minimum and maximum are exactly at corners.

#include <array>

#include "rasterizer/internal/edge_functions.h"
#include "rasterizer/internal/sample_frame.h"

namespace rastercheck::rasterizer {

struct Plane {
  double a = 0;
  double b = 0;
  double c = 0;  ///< already multiplied by T

  /// B V + C, the part that is constant along a row.
  double row(const SampleFrame& frame, double v) const { return b * frame.v.at(v) + c; }
};

/// Returns offset + scale Σ k_i E_i. All callers must share this order of operations. The evaluated
/// line is never −0.
inline Plane plane_of(const EdgeFunctions& edges, const std::array<double, 3>& k,
                      const SampleFrame& frame, double scale = 1, double offset = 0) {
  const auto sum = [&k](double first, double second, double third) {
    return (k[0] * first + k[1] * second) + k[2] * third;
  };
  return {sum(edges[0].a.value, edges[1].a.value, edges[2].a.value) * scale,
          sum(edges[0].b.value, edges[1].b.value, edges[2].b.value) * scale,
          sum(edges[0].c.value, edges[1].c.value, edges[2].c.value) * frame.t * scale + offset};
}

/// A plane on a row of samples, in the kernels' form.
struct PlaneRow {
  double a = 0;
  double row = 0;
};

inline PlaneRow plane_row(const Plane& plane, const SampleFrame& frame, double v) {
  return {plane.a, plane.row(frame, v)};
}

}  // namespace rastercheck::rasterizer
