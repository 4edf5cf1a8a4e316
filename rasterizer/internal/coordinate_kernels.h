#pragma once

// Serves the route “shaded frames” (docs/rasterizer.md, Routes).
//
// Texture coordinates of a batch's lanes, on the processor's widest vectors: the texels that the
// coordinates lie in or between, and the level of detail. All targets compute the same bits: each
// product and each sum is rounded separately and never fused.
//
// A coordinate s is wrapped to c in [0, 1]: for repeat, c = s − ⌊s⌋; for mirror, m = s − 2 ⌊s/2⌋
// and c = m or 2 − m; for clamp, c is the number in [0, 1] nearest to s. The only sums ever rounded
// are s + 1 and s + 2 for s in (−1, 0), by at most 2^-53. NaN becomes 0. So no lane is ever outside
// the texture, not even a helper with an infinite coordinate.

#include <array>
#include <cstddef>
#include <cstdint>

#include "rasterizer/shading.h"
#include "rasterizer/texture.h"

namespace rastercheck::rasterizer {

/// A coordinate of a batch.
struct TextureAxis {
  const double* values = nullptr;  ///< [lane]
  Wrap wrap = Wrap::repeat;
  int size = 1;  ///< width or height of level 0, in texels
};

/// Lane l is bit l % 64 of word l / 64.
using LaneMask = std::array<std::uint64_t, FragmentBatch::kLanes / 64>;

template <typename T>
using LaneArray = std::array<T, FragmentBatch::kLanes>;

/// Finds the texels that the coordinates lie in. Returns the lanes that double cannot decide, if a
/// coordinate s may have an error of e, the greater of `error` and kErrorShare |s|.
///
/// c has an error of e + 2^-53. c · size is at most `size`, so its rounding adds half a unit: its
/// error is at most size (e + 2^-52). The texel is certain if c · size is farther than this error
/// from the nearest whole number, or if the same texel is on both sides of that number (at 0 and
/// `size`, unless repeated). The margin is computed with 2^-51 in place of 2^-52, which also covers
/// its own two roundings. Lanes with a margin of 1/4 or more are left undecided.
LaneMask find_texels(const TextureAxis& axis, double error, std::size_t lanes, std::int32_t* at);

/// The two texels whose centres a coordinate x = c · size − 1/2 lies between: the lower is ⌊x⌋, in
/// −1…size − 1, and the fraction is x − ⌊x⌋.
struct Neighbors {
  alignas(64) LaneArray<std::int32_t> low;
  alignas(64) LaneArray<float> fraction;
};

/// Finds the neighbours in level 0. With `shrink`, finds them in each lane's own level, of size
/// max(1, ⌊size · factor · shrink[lane]⌋).
void find_neighbors(const TextureAxis& axis, std::size_t lanes, Neighbors& neighbors);
void find_neighbors(const TextureAxis& axis, std::size_t lanes, double factor, const double* shrink,
                    Neighbors& neighbors);

/// Screen derivatives of both coordinates, each [lane].
struct CoordinateSlopes {
  const double* s_u = nullptr;
  const double* s_v = nullptr;
  const double* t_u = nullptr;
  const double* t_v = nullptr;
};

/// The level of detail of each lane, as a whole number and a fraction.
struct LevelsOfDetail {
  alignas(64) LaneArray<double> shrink;  ///< 2^-level
  alignas(64) LaneArray<std::int32_t> level;
  alignas(64) LaneArray<float> fraction;
};

/// Computes λ = log2 ρ, clamped to 0…last. ρ is the greater of the lengths of (∂s/∂u W, ∂t/∂u H)
/// and (∂s/∂v W, ∂t/∂v H); a NaN length counts as 0. Returns true if any λ is above 0.
///
/// λ = (e + log2 m) / 2, where ρ² = m 2^e with m in [√½, √2]. The logarithm is the series
///
///   log2 m = 2/ln 2 (z + z³/3 + …),   z = (m − 1) / (m + 1).
///
/// |z| <= 0.1716, so the terms after z^11 are below 2/ln 2 |z|^13 / 13 / (1 − z²) < 2^-35.1. The
/// roundings of log2 m, at most 1/2, and of ρ² (four) are a few 2^-53; the rounding of the sum
/// e + log2 m < 2^5 is 2^-49. So λ has an error below 2^-36. λ is exact if ρ² is a power of two.
bool find_levels(const CoordinateSlopes& slopes, double width, double height, int last,
                 std::size_t lanes, LevelsOfDetail& levels);

}  // namespace rastercheck::rasterizer
