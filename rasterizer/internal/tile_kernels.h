#pragma once

// What is drawn into tiles on the widest vectors that the processor has: larger triangles by spans,
// fragments of small ones. All targets compute the same bits, and values those of block_kernels.h.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/kernel_setting.h"

namespace rastercheck::rasterizer {

/// Pixels per side: a row of a tile is a block.
inline constexpr int kTileSize = kBlockSize;
/// What whole vectors may read, or write back as it was, beyond the end of a tile's arrays.
inline constexpr int kTilePadding = 8;

/// A tile to be drawn into: what kernel settings and tiles (tile.h) say of it, as arrays.
struct TileArea {
  /// U of the samples of its columns and V of its rows. A vector more than it has may be read.
  const double* u = nullptr;
  const double* v = nullptr;
  float* depth = nullptr;  ///< [row][column], kTileSize columns
  std::span<float* const> attributes;
  const float* greatest = nullptr;  ///< depth of each band: no number in it is greater
};

/// Rows of a band of a tile.
inline constexpr int kBandSize = 8;
inline constexpr int kBands = kTileSize / kBandSize;

/// Whether a test leaves ever lesser depths in a framebuffer (lets_rise: ever greater ones), so
/// that a fragment that fails it now will fail it later.
constexpr bool lets_fall(DepthTest test) {
  return test == DepthTest::less || test == DepthTest::less_or_equal;
}
constexpr bool lets_rise(DepthTest test) {
  return test == DepthTest::greater || test == DepthTest::greater_or_equal;
}

/// The greatest of each band of a tile's depths.
void find_greatest(const float* depth, std::span<float, kBands> greatest);

/// Columns and rows of a tile.
struct TilePart {
  PixelRange columns;
  PixelRange rows;
};

/// A sample of a tile that a vertex lies on.
struct VertexSample {
  int column = 0;
  int row = 0;
  std::size_t vertex = 0;
};

/// What of a triangle was not drawn.
struct Undrawn {
  /// Rows with samples that may be covered, but within a band, or for which double is not enough.
  std::uint64_t rows = 0;
  std::size_t vertex_count = 0;
  std::array<VertexSample, 3> vertices;  ///< of other rows
};

/// Draws what of a triangle with these numbers (TriangleNumbers) lies in that part of a tile.
Undrawn draw_part(const KernelSetting& setting, const double* numbers, const TileArea& area,
                  const TilePart& part);

/// Draws the sample at a vertex; values[a] are its attributes.
void put_vertex(const KernelSetting& setting, const double* numbers, const VertexSample& sample,
                std::span<const float> values, const TileArea& area);

/// Draws fragments: words of key, depth and attributes one after the other.
void put_fragments(const KernelSetting& setting, std::span<const std::uint32_t> words,
                   const TileArea& area);

}  // namespace rastercheck::rasterizer
