#include "rasterizer/internal/tile.h"

#include <algorithm>
#include <array>

#include "rasterizer/internal/tile_kernels.h"

namespace rastercheck::rasterizer {

Tile::Tile(int samples, std::size_t attribute_count)
    : samples_(static_cast<std::size_t>(samples)),
      attribute_count_(attribute_count),
      depth_(samples_ * kTileSize * kTileSize),
      attributes_(depth_.size() * attribute_count) {}

void Tile::load(const Framebuffer& framebuffer, int column, int row) {
  columns_ = {column * kTileSize, std::min((column + 1) * kTileSize, framebuffer.size.width)};
  rows_ = {row * kTileSize, std::min((row + 1) * kTileSize, framebuffer.size.height)};
  for (int y = rows_.begin; y < rows_.end; ++y) {
    const std::size_t first =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(framebuffer.size.width) +
         static_cast<std::size_t>(columns_.begin)) *
        samples_;
    // Samples of a pixel side by side are to the kernels what attributes of a sample are.
    std::array<float*, kMaxAttributes * DrawBounds::kMaxSamples> rows{};
    for (std::size_t s = 0; s < samples_; ++s) rows[s] = depth(s, y);
    separate(framebuffer.depth.data() + first, {rows.data(), samples_}, width());
    for (std::size_t s = 0; s < samples_; ++s) {
      for (std::size_t a = 0; a < attribute_count_; ++a) {
        rows[s * attribute_count_ + a] = attribute(a, s, y);
      }
    }
    separate(framebuffer.attributes.data() + first * attribute_count_,
             {rows.data(), samples_ * attribute_count_}, width());
  }
}

void Tile::store(Framebuffer& framebuffer) const {
  for (int y = rows_.begin; y < rows_.end; ++y) {
    const std::size_t first =
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(framebuffer.size.width) +
         static_cast<std::size_t>(columns_.begin)) *
        samples_;
    std::array<const float*, kMaxAttributes * DrawBounds::kMaxSamples> rows{};
    for (std::size_t s = 0; s < samples_; ++s) rows[s] = depth_.data() + offset(s, y);
    interleave({rows.data(), samples_}, width(), framebuffer.depth.data() + first);
    for (std::size_t s = 0; s < samples_; ++s) {
      for (std::size_t a = 0; a < attribute_count_; ++a) {
        rows[s * attribute_count_ + a] = attributes_.data() + a * depth_.size() + offset(s, y);
      }
    }
    interleave({rows.data(), samples_ * attribute_count_}, width(),
               framebuffer.attributes.data() + first * attribute_count_);
  }
}

}  // namespace rastercheck::rasterizer
