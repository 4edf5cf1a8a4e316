#pragma once

// Moving tiles to and from framebuffers: there the numbers of a pixel lie side by side, in a tile
// each has an array of its own. On the widest vectors that the processor has.

#include <cstddef>
#include <span>

#include "rasterizer/internal/tile_kernels.h"

namespace rastercheck::rasterizer {

/// Rows of arrays in a tile, and of the same numbers side by side in a framebuffer.
struct TileRows {
  std::span<float* const> arrays;  ///< [k]: row after row of kTileSize
  std::size_t width = 0;           ///< of a row
  std::size_t height = 0;
  std::size_t pitch = 0;  ///< numbers from a row of the framebuffer to the next
  bool streams = false;   ///< interleave() writes past the caches, where it is made for `arrays`
};

/// out[pitch · y + count · i + k] = arrays[k][kTileSize · y + i], count = arrays.size().
void interleave(const TileRows& rows, float* out);
/// arrays[k][kTileSize · y + i] = in[pitch · y + count · i + k].
void separate(const float* in, const TileRows& rows);

}  // namespace rastercheck::rasterizer
