#pragma once

// A piece of a framebuffer that a thread has to itself while it draws, small enough for its caches:
// depths, and each attribute in an array of its own, as vectors want them.

#include <cstddef>
#include <vector>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Pixels per side: a row of a tile is a block.
inline constexpr int kTileSize = kBlockSize;

class Tile {
 public:
  /// Memory for tiles of framebuffers of that kind; none is needed later.
  Tile(int samples, std::size_t attribute_count);

  /// The tile's pixels of the framebuffer, at tile column and row.
  void load(const Framebuffer& framebuffer, int column, int row);
  /// Writes them back.
  void store(Framebuffer& framebuffer) const;

  const PixelRange& columns() const { return columns_; }
  const PixelRange& rows() const { return rows_; }

  /// The row of window row y: kTileSize values from columns().begin.
  float* depth(std::size_t sample, int y) { return depth_.data() + offset(sample, y); }
  float* attribute(std::size_t attribute, std::size_t sample, int y) {
    return attributes_.data() + attribute * depth_.size() + offset(sample, y);
  }

 private:
  std::size_t offset(std::size_t sample, int y) const {
    const auto row = static_cast<std::size_t>(y - rows_.begin);
    return (sample * kTileSize + row) * kTileSize;
  }
  std::size_t width() const { return static_cast<std::size_t>(columns_.end - columns_.begin); }

  std::size_t samples_;
  std::size_t attribute_count_;
  PixelRange columns_;
  PixelRange rows_;
  std::vector<float> depth_;       ///< [sample][row][column]
  std::vector<float> attributes_;  ///< [attribute][sample][row][column]
};

/// Tiles of a row and of a column that hold so many pixels.
constexpr int tiles_across(int pixels) { return (pixels + kTileSize - 1) / kTileSize; }

}  // namespace rastercheck::rasterizer
