#pragma once

// Whether double precision is enough for the values of a triangle. What an evaluation in double is
// off by comes from the E_i, each off by at most its band, and from a few roundings, u = 2^-53; a
// *certificate* shows that it is little:
//
//   smooth   |δr| <= max|r_i| (2 Σ band_i / D + 8u), so D >= 2^32 Σ band_i gives 2^-31 max|r_i|;
//            an ulp of max|r_i| is at least 2^-24 of it, hence at most 2^-7 scale ULP. With weights
//            of both signs (a centre outside) Σ|E_i| takes the place of D in the roundings.
//   affine   |δr| <= max|r_i| Σ |w_i| (band_i + 8u |E_i|) / (|det| T), certified below 2^-32.
//   depth    |δz| <= Σ |z_i| (band_i + 8u S_i) / (|det| T), certified below 2^-31; n, f and f − n
//            are at most max(|n|, |f|).
//
// With half an ULP for the rounding to float32 no value is off by more than kValueBound.

#include <array>

#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

struct Certificates {
  double band_sum = 0;             ///< Σ band_i
  double least_sum = 0;            ///< smooth values are certain where Σ E_i is above this
  bool affine_is_certain = false;  ///< affine values of covered samples are
  bool depth_is_certain = false;
  double affine_error = 0;  ///< Σ |w_i| band_i

  /// Of a smooth value, at weights of either sign.
  bool is_smooth_certain(const std::array<double, 3>& e) const;
  /// Of an affine value, at weights of either sign; `det_t` is that of the weights.
  bool is_affine_certain(const std::array<double, 3>& e, double det_t) const;
};

/// `w` and `z` of the corners that the weights belong to.
Certificates certify(const Weights& weights, const std::array<double, 3>& w,
                     const std::array<double, 3>& z);

}  // namespace rastercheck::rasterizer
