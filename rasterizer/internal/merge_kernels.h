#pragma once

// Serves the route “shaded frames” (docs/rasterizer.md, Routes).
//
// Merges shaded cells into a tile on the processor's widest vectors: depth test, blending and
// rounding to bytes. All targets compute the same bits.

#include <span>

#include "rasterizer/internal/cell_batch.h"
#include "rasterizer/internal/tile_kernels.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// How colours are merged into a tile.
struct Merging {
  DepthTest test = DepthTest::always;
  bool writes_depth = true;
  Blend blend = Blend::off;
  bool has_words = false;  ///< rgba8: one number of a tile holds a sample's four bytes
};

constexpr bool needs_depths(const Merging& merging) {
  return merging.writes_depth || merging.test != DepthTest::always;
}

/// Merges a batch's cells, except for discarded lanes, into a tile, in order. `areas` is indexed by
/// sample.
void merge_cells(const Merging& merging, const CellBatch& batch, int left, int top,
                 std::span<const TileArea> areas);

}  // namespace rastercheck::rasterizer
