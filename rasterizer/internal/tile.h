#pragma once

// A piece of a framebuffer that a thread has to itself while it draws, small enough for its caches:
// depths, and each attribute in an array of its own, as vectors want them.

#include <cstddef>
#include <vector>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/interleave.h"
#include "rasterizer/internal/tile_kernels.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

class Tile {
 public:
  /// Memory for tiles of framebuffers of that kind; none is needed later. `has_words`: of rgba8 the
  /// four bytes of a sample are the bits of one number, not four numbers.
  Tile(int samples, std::size_t attribute_count, bool has_words = false);
  Tile(const Tile&) = delete;  // it points into itself
  Tile& operator=(const Tile&) = delete;

  /// The tile's pixels of the framebuffer, at tile column and row.
  void load(const Picture& framebuffer, int column, int row);
  /// The same pixels, all of that depth and with attributes 0.
  void clear(const Picture& framebuffer, int column, int row, float depth);
  /// Writes them back; past the caches where clear(), not load(), put them here and caches do not
  /// hold a framebuffer of that size: they need not fetch what is overwritten.
  void store(Picture& framebuffer) const;

  const PixelRange& columns() const { return columns_; }
  const PixelRange& rows() const { return rows_; }

  /// One sample of all pixels, [row][column].
  float* depths(std::size_t sample) { return values_.data() + sample * kSize; }
  float* values(std::size_t attribute, std::size_t sample) {
    return values_.data() + (1 + attribute) * stride() + sample * kSize;
  }
  /// The row of window row y: kTileSize values from columns().begin.
  float* depth(std::size_t sample, int y) { return depths(sample) + offset(y); }
  float* attribute(std::size_t attribute, std::size_t sample, int y) {
    return values(attribute, sample) + offset(y);
  }

 private:
  static constexpr std::size_t kSize = std::size_t{kTileSize} * kTileSize;
  /// Between attributes. Were they multiples of 4096 bytes apart, processors would take a number
  /// written to one for that at the same place of another, and wait.
  static constexpr std::size_t kGap = 64;
  static_assert(kGap >= kTilePadding);

  /// From an attribute's samples to the next's.
  std::size_t stride() const { return samples_ * kSize + kGap; }
  void move_to(const Picture& framebuffer, int column, int row);
  std::size_t offset(int y) const { return static_cast<std::size_t>(y - rows_.begin) * kTileSize; }
  std::size_t first_pixel(const Picture& framebuffer) const;
  TileRows rows_of(std::span<float* const> arrays, const Picture& framebuffer) const;

  std::size_t samples_;
  std::size_t attribute_count_;
  bool has_words_;
  bool is_cleared_ = false;  ///< not loaded
  PixelRange columns_;
  PixelRange rows_;
  Picture::Values values_;  ///< depth and each attribute: [sample][row][column]
  // What lies side by side in framebuffers.
  std::vector<float*> depth_arrays_;      ///< [sample]
  std::vector<float*> attribute_arrays_;  ///< [sample][attribute]
};

/// Tiles of a row and of a column that hold so many pixels.
constexpr int tiles_across(int pixels) { return (pixels + kTileSize - 1) / kTileSize; }

}  // namespace rastercheck::rasterizer
