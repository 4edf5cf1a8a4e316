#pragma once

// Screen derivatives of attributes (RULES §4), rounded once. Of ∂/∂u; ∂/∂v likewise.
//
//   smooth         d = Σ E_i' (r_i − r) / D,    D = Σ E_i, E_i' = ∂E_i/∂u
//   noperspective  d = Σ E_i' r_i w_i / (|det| T), the same all over the triangle
//
// E_i' is a_i dU/du, so that the signs of viewport and convention, and the grid units of placed
// weights, are those of the frame (sample_frame.h): d is per pixel of the window as displayed.
//
// The unit of errors is ulp(max(|d|, M)), M = max|r_i| Σ|E_i'| / D (noperspective
// Σ|r_i w_i E_i'| / (|det| T)): d is a difference of terms of that size, and where they cancel no
// precision of the weights keeps its last digits.
//
// In double, where a certificate holds: D >= 2^33 Σ band_i, and Σ|E_i| <= 2 D, which is so of all
// samples inside and takes in those a little outside. With β = Σ band_i / D <= 2^-33, u = 2^-53 and
// m = max|r_i|, D is off by (β + 5u) of itself and N = Σ r_i E_i by m D (β + 7u). |r| is at most
// 2m, so r is off by m (3β + 20u). E_i' has two roundings, a difference of at most 3m, a product
// and the sums four more: the sum is off by m Σ|E_i'| (3β + 38u), the quotient by
// M (3β + 38u) + |d| (β + 6u) <= max(|d|, M) (4β + 44u). An ulp is at least 2^-24 of what it is of:
// that is 2^-7 + 2^-23 of the unit, with the rounding to float32 less than kDerivativeBound
// (rasterizer.h).
//
// Without a certificate the quotient rule, by minors: with p_k = (x, y, w) of the corners and
// (U, V, T) of the sample, E_i' E_j − E_i E_j' = ± |det| U' (w_k V − y_k T), i, j, k in cyclic
// order and ± the sign of det (the product of two cross products that share a factor), so that
//
//   d = (N' D − N D') / D² = ± |det| U' Σ (r_i − r_j) (w_k V − y_k T) / D²
//
// (for ∂/∂v: V' and x_k T − w_k U). The sum, D and |det| are summed without rounding and rounded
// once, to a relative 2^-50; nothing cancels after that. Five products and quotients of these keep
// d to 2^-48 of itself. Noperspective ones always go this way, once for each triangle. Numbers of
// new corners are within 2^-49 of the r_i (exact_values.h), and w within 2^-50: 2^-47 M inside
// their piece.
//
// Exponents: w_k V − y_k T is a multiple of 2^-447 below 2^387 (edge_functions.h), times r_i − r_j
// of 2^-596 below 2^516. Quotients leave the range of a double only where the result leaves that of
// float32: mantissas and exponents are kept apart until the end.
//
// The same attribute at all three vertices: 0. What lies beyond float32 becomes infinite.

#include <array>
#include <cstddef>
#include <vector>

#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

/// ∂r/∂u and ∂r/∂v, rounded to float32, and before that.
using Slopes = std::array<float, 2>;
using WideSlopes = std::array<double, 2>;

inline Slopes rounded(const WideSlopes& slopes) {
  return {static_cast<float>(slopes[0]), static_cast<float>(slopes[1])};
}

struct TriangleDerivatives {
  struct Line {
    bool is_constant = true;  ///< all over the triangle
    WideSlopes constant{};
    std::array<double, 3> r{};  ///< of one that is not: the corners' values
  };
  std::vector<Line> attributes;
  std::array<double, 3> along_u{};  ///< ∂E_i/∂u, with two roundings
  std::array<double, 3> along_v{};
  int turn = 1;        ///< the sign of det (x, y, w)
  ValueSource source;  ///< the corners
};

/// Prepares the derivatives of a triangle, or of one part of it, whose values are prepared.
void set_up_derivatives(const State& state, const ValueSource& source, const Weights& weights,
                        const TriangleValues& values, TriangleDerivatives& out);

/// A window position, and what all smooth attributes need of it.
struct DerivativeSite {
  double u = 0;
  double v = 0;
  std::array<double, 3> e{};
  double sum = 0;
  bool is_certain = false;  ///< whether double is enough
};
DerivativeSite derivative_site(const TriangleValues& values, const Weights& weights, double u,
                               double v);

/// Of an attribute at a site. Some number where an attribute is infinite or NaN, or undefined there
/// (a smooth one with 1/w <= 0).
WideSlopes derivatives_at(const TriangleDerivatives& triangle, const Weights& weights,
                          std::size_t attribute, const DerivativeSite& site);

}  // namespace rastercheck::rasterizer
