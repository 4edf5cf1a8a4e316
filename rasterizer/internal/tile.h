#pragma once

// Serves the route “frames” (docs/rasterizer.md, Routes).
//
// A rectangle of a framebuffer that one thread draws at a time. It is small enough for the
// processor's caches. Depths and each attribute are in separate arrays, as vectors need them.

#include <cstddef>
#include <vector>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/interleave.h"
#include "rasterizer/internal/tile_kernels.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

class Tile {
 public:
  /// Allocates all memory for tiles of framebuffers with these numbers of samples and attributes.
  /// `has_words` (rgba8): a sample's four bytes are stored as the bits of one number, not as four
  /// numbers.
  Tile(int samples, std::size_t attribute_count, bool has_words = false);
  Tile(const Tile&) = delete;  // it points into itself
  Tile& operator=(const Tile&) = delete;

  /// Reads the pixels of the tile at this tile column and row from the framebuffer.
  void load(const Picture& framebuffer, int column, int row);
  /// Moves to the same pixels as load() would; sets all depths to `depth` and attributes to 0.
  void clear(const Picture& framebuffer, int column, int row, float depth);
  /// Writes the pixels back. If the tile was filled by clear(), not load(), and the framebuffer is
  /// larger than the caches, bypasses the caches (streaming stores), so that overwritten memory
  /// need not be fetched first.
  void store(Picture& framebuffer) const;

  const PixelRange& columns() const { return columns_; }
  const PixelRange& rows() const { return rows_; }

  /// The values of one sample index for all pixels, [row][column].
  float* depths(std::size_t sample) { return values_.data() + sample * kSize; }
  float* values(std::size_t attribute, std::size_t sample) {
    return values_.data() + (1 + attribute) * stride() + sample * kSize;
  }

 private:
  static constexpr std::size_t kSize = std::size_t{kTileSize} * kTileSize;
  /// Gap between attributes. If attributes were multiples of 4096 bytes apart, processors would
  /// mistake a write to one attribute for a write to the same place of another, and stall.
  static constexpr std::size_t kGap = 64;
  static_assert(kGap >= kTilePadding);

  /// Distance from one attribute's samples to the next attribute's.
  std::size_t stride() const { return samples_ * kSize + kGap; }
  void move_to(const Picture& framebuffer, int column, int row);
  std::size_t first_pixel(const Picture& framebuffer) const;
  TileRows rows_of(std::span<float* const> arrays, const Picture& framebuffer) const;

  std::size_t samples_;
  std::size_t attribute_count_;
  bool has_words_;
  bool is_cleared_ = false;  ///< filled by clear(), not load()
  PixelRange columns_;
  PixelRange rows_;
  Picture::Values values_;  ///< depth, then each attribute: [sample][row][column]
  // Arrays whose numbers lie side by side in framebuffers.
  std::vector<float*> depth_arrays_;      ///< [sample]
  std::vector<float*> attribute_arrays_;  ///< [sample][attribute]
};

/// Number of tiles needed for a row or column of `pixels` pixels.
constexpr int tiles_across(int pixels) { return (pixels + kTileSize - 1) / kTileSize; }

}  // namespace rastercheck::rasterizer
