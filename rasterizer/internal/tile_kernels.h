#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Draws into tiles on the processor's widest vectors: larger triangles span by span, and fragments
// of small triangles. All targets compute the same bits, and the same values as block_kernels.h.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/kernel_setting.h"

namespace rastercheck::rasterizer {

/// Pixels per side of a tile; a row of a tile is a block.
inline constexpr int kTileSize = kBlockSize;
/// Padding after a tile's arrays. Whole vectors may read it, or write it back unchanged.
inline constexpr int kTilePadding = 8;

/// A tile to draw into, as arrays from the kernel setting and the tile (tile.h).
struct TileArea {
  /// U of the samples in each column of the tile, and V of the samples in each row; both arrays are
  /// readable for one vector beyond their end.
  const double* u = nullptr;
  const double* v = nullptr;
  float* depth = nullptr;  ///< [row][column], kTileSize columns
  std::span<float* const> attributes;
  const float* greatest = nullptr;  ///< [band]: upper bound of the band's depths
};

/// Rows per band of a tile.
inline constexpr int kBandSize = 8;
inline constexpr int kBands = kTileSize / kBandSize;

/// True if depths in a framebuffer can only decrease under this test (lets_rise: only increase), so
/// that a fragment that fails now would always fail later.
constexpr bool lets_fall(DepthTest test) {
  return test == DepthTest::less || test == DepthTest::less_or_equal;
}
constexpr bool lets_rise(DepthTest test) {
  return test == DepthTest::greater || test == DepthTest::greater_or_equal;
}

/// Finds the greatest depth of each band of a tile.
void find_greatest(const float* depth, std::span<float, kBands> greatest);

/// Columns and rows of a tile.
struct TilePart {
  PixelRange columns;
  PixelRange rows;
};

/// A sample of a tile that coincides with a vertex.
struct VertexSample {
  int column = 0;
  int row = 0;
  std::size_t vertex = 0;
};

/// The part of a triangle that was not drawn.
struct Undrawn {
  /// Rows with samples that may be covered but are within a band of an edge, or that double cannot
  /// decide.
  std::uint64_t rows = 0;
  std::size_t vertex_count = 0;
  std::array<VertexSample, 3> vertices;  ///< in rows that are not in `rows`
};

/// Draws the part of a triangle (given by TriangleNumbers) that lies inside `part`.
Undrawn draw_part(const KernelSetting& setting, const double* numbers, const TileArea& area,
                  const TilePart& part);

/// Draws the sample at a vertex, with the attributes `values`.
void put_vertex(const KernelSetting& setting, const double* numbers, const VertexSample& sample,
                std::span<const float> values, const TileArea& area);

/// Draws fragments, each given by consecutive words: key, depth and attributes.
void put_fragments(const KernelSetting& setting, std::span<const std::uint32_t> words,
                   const TileArea& area);

}  // namespace rastercheck::rasterizer
