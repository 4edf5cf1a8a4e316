#pragma once

// Moving tiles to and from framebuffers: there the numbers of a pixel lie side by side, in a tile
// each has an array of its own. On the widest vectors that the processor has.

#include <cstddef>
#include <cstdint>
#include <span>

namespace rastercheck::rasterizer {

/// Rows of arrays in a tile, and of the same numbers side by side in a framebuffer.
struct TileRows {
  std::span<float* const> arrays;  ///< [k]: row after row of kTileSize
  std::size_t width = 0;           ///< of a row
  std::size_t height = 0;
  std::size_t pitch = 0;  ///< pixels from a row of the framebuffer to the next
  bool streams = false;   ///< interleave() writes past the caches, where it is made for `arrays`
};

/// out[count (pitch · y + i) + k] = arrays[k][kTileSize · y + i], count = arrays.size().
void interleave(const TileRows& rows, float* out);
/// arrays[k][kTileSize · y + i] = in[count (pitch · y + i) + k].
void separate(const float* in, const TileRows& rows);

/// The same of four arrays for each sample to and from bytes k, which are k/255: the nearest, ties
/// to even, below 0 and NaN 0, above 1 255.
void interleave(const TileRows& rows, std::uint8_t* out);
void separate(const std::uint8_t* in, const TileRows& rows);

/// The same of arrays of four bytes' words to and from bytes.
void interleave_words(const TileRows& rows, std::uint8_t* out);
void separate_words(const std::uint8_t* in, const TileRows& rows);

}  // namespace rastercheck::rasterizer
