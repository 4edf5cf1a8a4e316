#pragma once

// Texture coordinates of a batch's lanes on the widest vectors that the processor has: the texels
// that they are in or between, and the level of detail. All targets compute the same bits: products
// and sums are rounded one by one and never fused.
//
// A coordinate is wrapped to c in [0, 1], repeat c = s − ⌊s⌋, mirror m = s − 2 ⌊s/2⌋ and c = m or
// 2 − m, clamp the nearest number of [0, 1]. Only one sum of these is ever rounded: s + 1 or s + 2
// for s in (−1, 0), by at most 2^-53. What is no number is 0. So no lane, a helper's infinite one
// included, is ever outside the texture.

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
  int size = 1;  ///< texels of level 0
};

/// Lane l is bit l % 64 of word l / 64.
using LaneMask = std::array<std::uint64_t, FragmentBatch::kLanes / 64>;

template <typename T>
using LaneArray = std::array<T, FragmentBatch::kLanes>;

/// The texels that the coordinates are in. Returns the lanes for which double does not tell which:
/// a coordinate s may be off by e, `error` or kErrorShare |s|, whichever is more.
///
/// c is off by e + 2^-53 and c · size, at most `size`, by half a unit more: at most
/// size (e + 2^-52). The texel is certain where c · size is farther than that from the nearest
/// whole number, or where on both sides of that is the same texel: at 0 and `size` unless repeated.
/// The margin is computed with 2^-51, as its own two roundings are below 2^-52 of it; lanes where
/// it is 1/4 or more are left open.
LaneMask find_texels(const TextureAxis& axis, double error, std::size_t lanes, std::int32_t* at);

/// Between the centres of which texels coordinates are: x = c · size − 1/2 as low = ⌊x⌋, which is
/// −1…size − 1, and x − low.
struct Neighbors {
  alignas(64) LaneArray<std::int32_t> low;
  alignas(64) LaneArray<float> fraction;
};

/// In level 0 or, with `shrink`, where level sizes are max(1, ⌊size · factor · shrink[lane]⌋).
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

/// The level of detail of each lane, in two parts.
struct LevelsOfDetail {
  alignas(64) LaneArray<double> shrink;  ///< 2^-level
  alignas(64) LaneArray<std::int32_t> level;
  alignas(64) LaneArray<float> fraction;
};

/// λ = log2 ρ, held to 0…last, where ρ is the greater of the lengths of (∂s/∂u W, ∂t/∂u H) and
/// (∂s/∂v W, ∂t/∂v H). A length that is no number counts as 0. Returns whether any λ is above 0.
///
/// λ = (e + log2 m) / 2, ρ² = m 2^e with m in [√½, √2], and z = (m − 1) / (m + 1) for
/// log2 m = 2/ln 2 (z + z³/3 + …). |z| <= 0.1716, so that what follows z^11 is below
/// 2/ln 2 |z|^13 / 13 / (1 − z²) < 2^-35.1. Of roundings, those of log2 m, at most 1/2, and of ρ²
/// (four) are a few 2^-53 of 1, that of the sum e + log2 m < 2^5 is 2^-49: λ is off by less than
/// 2^-36. It is exact where ρ² is a power of two.
bool find_levels(const CoordinateSlopes& slopes, double width, double height, int last,
                 std::size_t lanes, LevelsOfDetail& levels);

}  // namespace rastercheck::rasterizer
