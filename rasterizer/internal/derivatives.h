#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Screen derivatives of attributes (RULES §4), rounded once. Shown for ∂/∂u; ∂/∂v likewise.
//
//   smooth         d = Σ E_i' (r_i − r) / D,    D = Σ E_i, E_i' = ∂E_i/∂u
//   noperspective  d = Σ E_i' r_i w_i / (|det| T), constant over the triangle
//
// E_i' is a_i dU/du. The signs of viewport and convention, and the grid units of placed weights,
// are included in the frame (sample_frame.h), so d is per pixel of the window as displayed.
//
// The unit of errors is ulp(max(|d|, M)), where M = max|r_i| Σ|E_i'| / D (noperspective:
// Σ|r_i w_i E_i'| / (|det| T)). d is a difference of terms of size M; where the terms cancel, the
// last digits of d are lost, however precise the weights are.
//
// Double suffices if a certificate holds: D >= 2^33 Σ band_i and Σ|E_i| <= 2 D. The second
// condition holds for all samples inside and for samples a little outside. With
// β = Σ band_i / D <= 2^-33, u = 2^-53 and m = max|r_i|, D has a relative error of β + 5u, and
// N = Σ r_i E_i an error of m D (β + 7u). |r| is at most 2m, so r has an error of m (3β + 20u).
// E_i' has two roundings; the difference r_i − r (at most 3m), a product and the sums have four
// more. The sum therefore has an error of m Σ|E_i'| (3β + 38u), and the quotient an error of M
// (3β + 38u) + |d| (β + 6u) <= max(|d|, M) (4β + 44u). An ulp is at least 2^-24 of its number, so
// this is 2^-7 + 2^-23 of the unit. With the rounding to float32 it is less than kDerivativeBound
// (rasterizer.h).
//
// Without a certificate, d comes from the quotient rule in terms of minors. Let p_k = (x, y, w) be
// the corners and (U, V, T) the sample. Then E_i' E_j − E_i E_j' = ± |det| U' (w_k V − y_k T),
// where i, j, k are in cyclic order and ± is the sign of det: the identity for the cross product of
// two cross products with a common factor. So
//
//   d = (N' D − N D') / D² = ± |det| U' Σ (r_i − r_j) (w_k V − y_k T) / D²
//
// (for ∂/∂v: V' and x_k T − w_k U). The sum, D and |det| are summed without rounding and then
// rounded once, with a relative error of at most 2^-50; nothing cancels after that. Five products
// and quotients of these give d a relative error of 2^-48. Noperspective derivatives are always
// computed this way, once per triangle. The values at new corners are within 2^-49 of the r_i
// (exact_values.h), and w within 2^-50: this adds 2^-47 M inside their piece.
//
// Exponents: w_k V − y_k T is a multiple of 2^-447 below 2^387 (edge_functions.h). The product with
// r_i − r_j is a multiple of 2^-596 below 2^516. Quotients leave the range of double only if the
// result leaves the range of float32; mantissas and exponents are kept apart until the end.
//
// If all three vertices have the same attribute, d is 0. Results beyond float32 become infinite.

#include <array>
#include <cstddef>
#include <vector>

#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

/// ∂r/∂u and ∂r/∂v: Slopes after, WideSlopes before, rounding to float32.
using Slopes = std::array<float, 2>;
using WideSlopes = std::array<double, 2>;

inline Slopes rounded(const WideSlopes& slopes) {
  return {static_cast<float>(slopes[0]), static_cast<float>(slopes[1])};
}

struct TriangleDerivatives {
  struct Line {
    bool is_constant = true;  ///< true if the same over the whole triangle
    WideSlopes constant{};
    std::array<double, 3> r{};  ///< the corners' values; used unless `is_constant`
  };
  std::vector<Line> attributes;
  std::array<double, 3> along_u{};  ///< ∂E_i/∂u, with two roundings
  std::array<double, 3> along_v{};
  int turn = 1;        ///< the sign of det (x, y, w)
  ValueSource source;  ///< the corners
};

/// Prepares the derivatives of a triangle, or of one of its parts. Values must be prepared already.
void set_up_derivatives(const State& state, const ValueSource& source, const Weights& weights,
                        const TriangleValues& values, TriangleDerivatives& out);

/// A window position, with the data that all smooth attributes need there.
struct DerivativeSite {
  double u = 0;
  double v = 0;
  std::array<double, 3> e{};
  double sum = 0;
  bool is_certain = false;  ///< true if double suffices
};
DerivativeSite derivative_site(const TriangleValues& values, const Weights& weights, double u,
                               double v);

/// Returns the derivatives of an attribute at a site. They are arbitrary if an attribute is
/// infinite or NaN, or if it is undefined there (a smooth attribute with 1/w <= 0).
WideSlopes derivatives_at(const TriangleDerivatives& triangle, const Weights& weights,
                          std::size_t attribute, const DerivativeSite& site);

}  // namespace rastercheck::rasterizer
