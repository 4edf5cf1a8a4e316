#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The offset o = m · slope + r · constant of a triangle's depths (DepthBias). It is computed once
// for each triangle and added to the constant of the depth's plane, so that a biased sample costs
// what any sample costs.
//
// In double. n and f are the ends of the depth range, M = max(n, f) and u = 2^-53.
//
//   r      is exact, and so is r · constant, a product of two numbers of 24 bits. The exponent of a
//          float32 depth comes from n + (f − n) z/w in double. If n = 0, f = 1 and clip depth
//          begins at 0, that is z/w: its exponent is right, because floats z < 2^k w are at most (1
//          − 2^-24) 2^k w. Otherwise a depth within the range is off by at most 8u M, from the
//          roundings of n, f − n, z/w, their product and sum (of terms below 2M); the exponent is
//          certain if both ends of that interval have it.
//   m      is |A| (|B|) of the depth's plane times the change of U (V) per pixel. Its roundings are
//          those of plane.h, and three of the scale and the change per pixel: together they are
//          below 16u of m's terms, Σ |k_i a_i| in place of |Σ k_i a_i|. The determinant adds 2^-34
//          of m (weights.h).
//   o      The double is trusted if |slope| Σ |k_i a_i| + |r constant| <= 2^12 M, with the factors
//          that m has, and |slope| m <= M/4: then it is within 2^-37 M + 2^-36 M of o. Clamping to
//          the bias's clamp cannot make this worse.
//
// Otherwise o is formed from sums without rounding, o |det| T = slope (f − n) |Σ k_i ∂E_i| +
// r constant |det| T, and divided once: a relative error of 2^-50. Its error is then at most
// 2^-49 max(|d|, M) of the biased depth d if the depth before it is within the range.
//
// Depths beyond the range. With depth clamp, for samples outside the triangle of the clip positions
// (snapping) or of any triangle (Conservative::outer), the depth may be far beyond the range and a
// large offset may bring it back, so that both cancel. Then the offset is `deep`, unless |o| <= M:
// the whole of d |det| T is summed without rounding at each sample.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>

#include "rasterizer/internal/plane.h"
#include "rasterizer/internal/weights.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// The offset is certain in double up to these multiples of M.
inline constexpr double kMostBiasTerms = 0x1p12;
inline constexpr double kMostBiasRise = 0x1p-2;
/// r of float32 is this times 2^e.
inline constexpr double kFloatStep = 0x1p-23;
/// The bits of a double's exponent: of a number above 0, they alone are 2^e.
inline constexpr std::uint64_t kExponentBits = 0x7ff0'0000'0000'0000;

/// A draw's bias. The offsets of its triangles are computed from this.
struct BiasTerms {
  bool is_any = false;  ///< false if nothing is biased; the other members are then not set
  double constant = 0;
  double slope = 0;
  double clamp = 0;
  double unit = 0;  ///< r of a unorm format; 0 if it is the vertices' exponent that decides r
  double near = 0;
  double far = 0;
  bool is_halved = false;  ///< depth is n + (f − n) (z/w + 1)/2
  double low = 0;          ///< depth is low + span · z/w, in double
  double span = 0;
  double least = 0;           ///< min(n, f)
  double greatest = 0;        ///< max(n, f), which is M
  double exponent_error = 0;  ///< error of a vertex's depth in double; 0 if its exponent is right
  bool may_leave = false;     ///< depths before the bias may be outside the range

  /// True if double suffices for an offset with these terms: |slope| m, and the sum of the sizes of
  /// all terms. NaN is not certain.
  bool is_certain(double rise, double terms) const {
    return terms <= kMostBiasTerms * greatest && rise <= kMostBiasRise * greatest;
  }
  bool is_deep(double offset) const { return may_leave && !(std::abs(offset) <= greatest); }
  double clamped(double offset) const {
    if (clamp > 0) return std::min(offset, clamp);
    return clamp < 0 ? std::max(offset, clamp) : offset;
  }
};
BiasTerms bias_terms(const State& state);

/// A triangle whose depth is z = Σ k_i E_i / (|det| T) in clip space, with w of the weights'
/// corners.
struct SlopedDepth {
  const Weights& weights;
  const std::array<double, 3>& w;
  const std::array<double, 3>& k;
};

/// o of a triangle.
struct DepthOffset {
  double value = 0;
  /// Without rounding, o is level + slope · m.
  double level = 0;
  double slope = 0;
  bool is_deep = false;
};

using ClipPositions = std::array<glm::vec4, 3>;

/// Returns the offset of a plane of constant depth.
DepthOffset level_offset(const BiasTerms& bias, const ClipPositions& vertices);
/// Returns the offset of any other plane. `plane` is that of the depth without bias, and `scale`
/// the factor of its sums (plane_of).
DepthOffset sloped_offset(const BiasTerms& bias, const ClipPositions& vertices,
                          const SlopedDepth& depth, const Plane& plane, double scale);

/// Returns the biased depth, before it is clamped, of a plane of constant depth z/w: without
/// rounding before the last.
double deep_level_depth(const BiasTerms& bias, const DepthOffset& offset, double z, double w);
/// Likewise of any other plane, at (u, v).
double deep_depth_at(const BiasTerms& bias, const DepthOffset& offset, const SlopedDepth& depth,
                     double u, double v);

}  // namespace rastercheck::rasterizer
