#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// Copies tiles to and from framebuffers, on the processor's widest vectors. In a framebuffer the
// numbers of a pixel lie side by side; in a tile each number of the pixel is in a separate array.

#include <cstddef>
#include <cstdint>
#include <span>

namespace rastercheck::rasterizer {

/// Rows of arrays in a tile, and their layout side by side in a framebuffer.
struct TileRows {
  std::span<float* const> arrays;  ///< [k]: row after row of kTileSize
  std::size_t width = 0;           ///< pixels per row
  std::size_t height = 0;
  std::size_t pitch = 0;  ///< pixels from a row of the framebuffer to the next
  bool streams = false;   ///< true if interleave() bypasses the caches, if possible
};

/// Sets out[count (pitch · y + i) + k] = arrays[k][kTileSize · y + i], where count = arrays.size().
void interleave(const TileRows& rows, float* out);
/// Sets arrays[k][kTileSize · y + i] = in[count (pitch · y + i) + k].
void separate(const float* in, const TileRows& rows);

/// The same for four arrays per sample, to and from bytes. Byte k means k/255. Numbers are rounded
/// to the nearest byte, ties to even; numbers below 0 and NaN become 0, numbers above 1 become 255.
void interleave(const TileRows& rows, std::uint8_t* out);
void separate(const std::uint8_t* in, const TileRows& rows);

/// The same for arrays of four-byte words; a framebuffer holds the words as bytes.
void interleave_words(const TileRows& rows, std::uint8_t* out);
void separate_words(const std::uint8_t* in, const TileRows& rows);

}  // namespace rastercheck::rasterizer
