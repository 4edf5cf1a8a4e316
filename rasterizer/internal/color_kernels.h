#pragma once

// Colours of a batch's lanes on the widest vectors that the processor has: of texels, fetched or
// filtered, and of attributes. All targets compute the same bits: products and sums are rounded one
// by one and never fused.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/internal/coordinate_kernels.h"

namespace rastercheck::rasterizer {

/// Levels of a texture of kMaxSize, and one to spare.
inline constexpr std::size_t kLevelSlots = 16;

/// A texture's texels, level after level, and what is beyond its edges.
struct TexelLevels {
  const std::uint32_t* texels = nullptr;
  int width = 1;
  int height = 1;
  bool repeats_columns = false;  ///< or they are clamped, mirrored ones too
  bool repeats_rows = false;
  alignas(64) std::array<std::int32_t, kLevelSlots> first{};  ///< of each level
  alignas(64) std::array<std::int32_t, kLevelSlots> next{};   ///< of the one after, if there is one
};

/// A square of four texels for each lane.
struct Squares {
  Neighbors columns;
  Neighbors rows;
};

using ColorArrays = std::span<float* const, 4>;

// Of lanes that are not wanted no texels are fetched but the first two of the texture, if it has
// two.

/// Colours k/255 of texels, correctly rounded: v/255 = q (1 + 2^-16 + 2^-32 + …) with
/// q = v (2^-8 + 2^-16), exact for whole v, and q (2^-16 + 2^-32) is added to it. What that lacks,
/// 2^-47, is too little to matter (tests/rasterizer/texture_test.cpp goes through all k).
void fetch_texels(const TexelLevels& texture, const std::int32_t* columns, const std::int32_t* rows,
                  const LaneMask& wanted, std::size_t lanes, ColorArrays color);

/// Filtered colours: bilinear ones of level 0, and trilinear ones of two levels. Bounds are derived
/// in texture.h.
void filter_bilinear(const TexelLevels& texture, const Squares& squares, const LaneMask& wanted,
                     std::size_t lanes, ColorArrays color);
void filter_trilinear(const TexelLevels& texture, const LevelsOfDetail& levels,
                      const std::array<Squares, 2>& squares, const LaneMask& wanted,
                      std::size_t lanes, ColorArrays color);

/// out[lane] is in[lane], rounded once.
void round_lanes(const double* in, std::size_t lanes, float* out);

/// The lanes whose values are below the limit.
LaneMask find_below(const float* values, float limit, std::size_t lanes);

}  // namespace rastercheck::rasterizer
