#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Decides whether double precision suffices for the values of a triangle. In double, a value's
// error comes from the E_i, each within its band, and from a few roundings of u = 2^-53 each. E_i,
// S_i, T, U and V are those of edge_functions.h. A *certificate* proves that this error is small:
//
//   smooth   |δr| <= (max|r_i| + |r|) (Σ plane_band_i / D) + 4u |r| (plane.h). If
//            D >= 2^32 (1 + 2^-8) Σ plane_band_i, this is less than 2^-31 max(|r_i|, |r|). An ulp
//            of that maximum is at least 2^-24 of it, so the error is at most 2^-7 scale ULP. D is
//            the computed value, so no second-order term is neglected; the 2^-8 covers 4u. A
//            certificate for one sample uses the sample's E_i: band_i replaces plane_band_i, and
//            8u Σ|E_i| is added for their roundings.
//   affine   |δr| <= max|r_i| Σ |w_i| plane_band_i / (|det| T), certified below 2^-33. The
//            determinant adds 2^-33: together 2^-32.
//   depth    |δz| <= Σ |z_i| (9u S_i plus the errors of U and V) / (|det| T). This is below 9/8
//            2^-32, because Σ |z_i| plane_band_i is certified below 2^-32. The determinant adds
//            2^-34 |z|: its real error (4u) is half of the tested one (8u, weights.h). Depth is n +
//            (f − n) z for the depth range from n to f (exact_values.h), and adding n adds 3u. |n|,
//            |f| and |f − n| are at most max(|n|, |f|); if vertices are snapped and z leaves [0,
//            1], |(f − n) z| <= 2 max(|n|, |f|, |depth|). Together below 2^-31 of that maximum.
//   bias     is certified by depth_bias.h: its error is below 2^-35 M, M = max(|n|, |f|). It adds u
//            of itself where it is added, and as much each time its sum with a depth is rounded. If
//            depths before it are within the range, the errors above are below (9/8 2^-32 +
//            2^-34) M. If they may leave it, |bias| <= M, so that a depth whose sum d with the bias
//            is not clamped has |(f − n) z| <= 3 max(M, |d|), and the determinant adds 3 · 2^-34 of
//            that maximum. Together below 2^-31 of it: 9/8 + 3/4 + 1/8 = 2, and the bias's error is
//            really below 3/2 2^-36. Clamping keeps errors from growing, and moves a sum beyond the
//            limits to the nearest of them, as it moves the exact one, but for that error.
//
// A unorm depth (depth_store.h) is at most 1, so before it is stored it is off by less than 2^-31,
// which is 2^-7 of a step of 24 bits, the product with the number of steps included.
//
// With half an ULP for the rounding to float32, no value has an error above kValueBound
// (rasterizer.h). If rounding reaches the next power of two, the rounding error is at most half of
// the smaller ulp below that power.
//
// Helper lanes (shading.h). Bands are computed from the S_i over the draw's pixels. A helper is a
// neighbour of a covered lane, so it lies at most one pixel beyond these pixels. U (V likewise) is
// affine. Let p and q be U at the two sides of the pixels, and d the size of its change per pixel,
// so |q − p| >= d. At the helper |U| <= max(|p|, |q|) + d, and max(|p|, |q|) >= d/2. So S_i, and
// the errors of U and V, are at most three times their values inside. The errors of smooth planes
// grow by the same factor. The planes are used although D' at the helper may be less than the D
// that the certificate holds for. With g = max(1, D / D') <= 2^16,
//
//   |δr'| <= 2 M' 3 Σ plane_band_i / D' (1 + 2^-13) <= 6 g 2^-32 M' < 2^-29 g M',
//
// where M' = max(max|r_i|, |r'|). For greater g, 1/w is about 0 or below, and helpers get arbitrary
// numbers. Affine helpers have smaller errors: 3 2^-33 max|r_i| + 2^-33 |r'|.

#include <array>

#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

/// The least ratio of D to its error at which smooth values are certain.
inline constexpr double kSmoothCertainty = 0x1.01p32;
/// The least ratio of |det| T to the values' errors at which affine values, or depth, are certain.
inline constexpr double kAffineCertainty = 0x1p33;
inline constexpr double kDepthCertainty = 0x1p32;

struct Certificates {
  double band_sum = 0;             ///< Σ band_i
  double least_sum = 0;            ///< smooth values are certain if D is above this
  bool affine_is_certain = false;  ///< true if affine values of covered samples are certain
  bool depth_is_certain = false;
  double affine_error = 0;  ///< Σ |w_i| plane_band_i

  /// True if a smooth value is certain at these weights, which may have either sign.
  bool is_smooth_certain(const std::array<double, 3>& e) const;
  /// True if an affine value is certain at these weights; `det_t` is their Σ w_i E_i. False if
  /// Σ |E_i| and Σ E_i differ, because a weight is then negative.
  bool is_affine_certain(const std::array<double, 3>& e, double det_t) const;
};

/// Makes the certificates. `w` and `z` are those of the weights' corners.
Certificates certify(const Weights& weights, const std::array<double, 3>& w,
                     const std::array<double, 3>& z);

}  // namespace rastercheck::rasterizer
