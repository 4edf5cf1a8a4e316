#pragma once

// Serves the route “shaded frames” (docs/rasterizer.md, Routes).
//
// Computes colours of a batch's lanes, from texels (fetched or filtered) or from attributes, on the
// processor's widest vectors. All targets compute the same bits: each product and each sum is
// rounded separately and never fused.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/internal/coordinate_kernels.h"

namespace rastercheck::rasterizer {

/// The number of levels of a texture of size kMaxSize (15), plus one spare slot.
inline constexpr std::size_t kLevelSlots = 16;

/// A texture's texels, level after level, and how it continues beyond its edges.
struct TexelLevels {
  const std::uint32_t* texels = nullptr;
  int width = 1;
  int height = 1;
  bool repeats_columns = false;  ///< if false, columns are clamped, even for Wrap::mirror
  bool repeats_rows = false;
  alignas(64) std::array<std::int32_t, kLevelSlots> first{};  ///< [level]: its first texel
  alignas(64) std::array<std::int32_t, kLevelSlots> next{};   ///< first[level + 1], if it exists
};

/// A square of four texels for each lane.
struct Squares {
  Neighbors columns;
  Neighbors rows;
};

using ColorArrays = std::span<float* const, 4>;

// For lanes that are not wanted, only the texture's first two texels (or its only one) are read.

/// Colours k/255 of texels, correctly rounded. k/255 = q (1 + 2^-16 + 2^-32 + …) with q = k (2^-8 +
/// 2^-16), which is exact for whole k. The code adds q (2^-16 + 2^-32) to q. The rest, 2^-47, is
/// too small to matter (tests/rasterizer/texture_test.cpp checks all k).
void fetch_texels(const TexelLevels& texture, const std::int32_t* columns, const std::int32_t* rows,
                  const LaneMask& wanted, std::size_t lanes, ColorArrays color);

/// Filtered colours: bilinear in level 0, or trilinear between two levels. texture.h derives the
/// bounds.
void filter_bilinear(const TexelLevels& texture, const Squares& squares, const LaneMask& wanted,
                     std::size_t lanes, ColorArrays color);
void filter_trilinear(const TexelLevels& texture, const LevelsOfDetail& levels,
                      const std::array<Squares, 2>& squares, const LaneMask& wanted,
                      std::size_t lanes, ColorArrays color);

/// Sets out[lane] to in[lane], rounded once.
void round_lanes(const double* in, std::size_t lanes, float* out);

/// Returns the lanes whose values are below `limit`.
LaneMask find_below(const float* values, float limit, std::size_t lanes);

}  // namespace rastercheck::rasterizer
