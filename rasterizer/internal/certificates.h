#pragma once

// Whether double precision is enough for the values of a triangle. What an evaluation in double is
// off by comes from the E_i, each off by at most its band, and from a few roundings, u = 2^-53; a
// *certificate* shows that it is little:
//
//   smooth   |δr| <= (max|r_i| + |r|) (Σ plane_band_i / D) + 4u |r| (plane.h), so that
//            D >= 2^32 (1 + 2^-8) Σ plane_band_i leaves less than 2^-31 max(|r_i|, |r|); an ulp of
//            that is at least 2^-24 of it, hence at most 2^-7 scale ULP. D is the computed one, so
//            nothing is left out as of second order; the 2^-8 pays for 4u. For one sample, from its
//            E_i: band_i for plane_band_i, besides roundings of 8u Σ|E_i|.
//   affine   |δr| <= max|r_i| Σ |w_i| plane_band_i / (|det| T), certified below 2^-33, and 2^-33
//            for the determinant: together 2^-32.
//   depth    |δz| <= Σ |z_i| (9u S_i and what U and V are off by) / (|det| T), below
//            9/8 2^-32, as Σ |z_i| plane_band_i is certified below 2^-32; 2^-34 |z| for the
//            determinant, whose 4u are half of what is certified (weights.h); 3u for the offset.
//            n, f and f − n are at most max(|n|, |f|); where vertices are snapped and z leaves
//            [0, 1], |(f − n) z| <= 2 max(|n|, |f|, |depth|). Together below 2^-31 of that.
//
// So with half an ULP for the rounding to float32 no value is off by more than kValueBound
// (rasterizer.h). A value that rounding takes to the next power of two is nearer to it than half
// the ulp below.
//
// Helper lanes (shading.h). The S_i that bands are made of are those of the draw's pixels, of which
// a covered lane's neighbour lies one beyond at most. U (V likewise) is affine: with p and q its
// values at the two sides of these pixels, q − p at least a pixel d, it is at most max(|p|, |q|) +
// d there, and max(|p|, |q|) >= d/2. So S_i, and what U and V are off by, are at most three times
// what they are within. The planes of smooth values are off by as much more, and are taken although
// D' at the helper may be less than D, which the certificate is for: with g = max(1, D / D') <=
// 2^16
//
//   |δr'| <= 2 M' 3 Σ plane_band_i / D' (1 + 2^-13) <= 6 g 2^-32 M' < 2^-29 g M',
//
// M' = max(max|r_i|, |r'|). Beyond that 1/w is about 0 or below, and helpers have some number.
// Affine ones have 3 2^-33 max|r_i| + 2^-33 |r'|, which is less.

#include <array>

#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

/// How many times the error of D it is to be at least.
inline constexpr double kSmoothCertainty = 0x1.01p32;
/// How many times their errors |det| T is to be at least.
inline constexpr double kAffineCertainty = 0x1p33;
inline constexpr double kDepthCertainty = 0x1p32;

struct Certificates {
  double band_sum = 0;             ///< Σ band_i
  double least_sum = 0;            ///< smooth values are certain where D is above this
  bool affine_is_certain = false;  ///< affine values of covered samples are
  bool depth_is_certain = false;
  double affine_error = 0;  ///< Σ |w_i| plane_band_i

  /// Of a smooth value, at weights of either sign.
  bool is_smooth_certain(const std::array<double, 3>& e) const;
  /// Of an affine value, at weights of either sign; `det_t` is that of the weights.
  bool is_affine_certain(const std::array<double, 3>& e, double det_t) const;
};

/// `w` and `z` of the corners that the weights belong to.
Certificates certify(const Weights& weights, const std::array<double, 3>& w,
                     const std::array<double, 3>& z);

}  // namespace rastercheck::rasterizer
