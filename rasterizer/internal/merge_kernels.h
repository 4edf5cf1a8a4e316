#pragma once

// Merging shaded cells into a tile on the widest vectors that the processor has: depth test,
// blending, rounding to bytes. All targets compute the same bits.

#include <span>

#include "rasterizer/internal/cell_batch.h"
#include "rasterizer/internal/tile_kernels.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// How colours go into a tile.
struct Merging {
  DepthTest test = DepthTest::always;
  bool writes_depth = true;
  Blend blend = Blend::off;
  bool has_words = false;  ///< of rgba8: the bits of the tile's only numbers
};

constexpr bool needs_depths(const Merging& merging) {
  return merging.writes_depth || merging.test != DepthTest::always;
}

/// Merges what a batch's cells leave into a tile, in their order; areas[sample].
void merge_cells(const Merging& merging, const CellBatch& batch, int left, int top,
                 std::span<const TileArea> areas);

}  // namespace rastercheck::rasterizer
