#include "rasterizer/internal/tile.h"

#include <algorithm>
#include <utility>

namespace rastercheck::rasterizer {

Tile::Tile(int samples, std::size_t attribute_count)
    : samples_(static_cast<std::size_t>(samples)),
      attribute_count_(attribute_count),
      values_(samples_ * (1 + attribute_count) * kStride) {
  for (std::size_t s = 0; s < samples_; ++s) {
    depth_arrays_.push_back(depths(s));
    for (std::size_t a = 0; a < attribute_count_; ++a) attribute_arrays_.push_back(values(a, s));
  }
}

void Tile::move_to(const Framebuffer& framebuffer, int column, int row) {
  columns_ = {column * kTileSize, std::min((column + 1) * kTileSize, framebuffer.size.width)};
  rows_ = {row * kTileSize, std::min((row + 1) * kTileSize, framebuffer.size.height)};
}

void Tile::clear(const Framebuffer& framebuffer, int column, int row, float depth) {
  move_to(framebuffer, column, row);
  float* const attributes = values_.data() + samples_ * kStride;
  std::fill(values_.data(), attributes, depth);
  std::fill(attributes, values_.data() + values_.size(), 0.0F);
}

std::size_t Tile::first_pixel(const Framebuffer& framebuffer) const {
  return static_cast<std::size_t>(rows_.begin) * static_cast<std::size_t>(framebuffer.size.width) +
         static_cast<std::size_t>(columns_.begin);
}

TileRows Tile::rows_of(std::span<float* const> arrays, const Framebuffer& framebuffer) const {
  return {arrays, static_cast<std::size_t>(columns_.end - columns_.begin),
          static_cast<std::size_t>(rows_.end - rows_.begin),
          static_cast<std::size_t>(framebuffer.size.width) * arrays.size()};
}

void Tile::load(const Framebuffer& framebuffer, int column, int row) {
  move_to(framebuffer, column, row);
  const std::size_t first = first_pixel(framebuffer);
  for (const auto& [arrays, values] :
       {std::pair(&depth_arrays_, framebuffer.depth.data()),
        std::pair(&attribute_arrays_, framebuffer.attributes.data())}) {
    separate(values + first * arrays->size(), rows_of(*arrays, framebuffer));
  }
}

void Tile::store(Framebuffer& framebuffer) const {
  const std::size_t first = first_pixel(framebuffer);
  for (const auto& [arrays, values] :
       {std::pair(&depth_arrays_, framebuffer.depth.data()),
        std::pair(&attribute_arrays_, framebuffer.attributes.data())}) {
    interleave(rows_of(*arrays, framebuffer), values + first * arrays->size());
  }
}

}  // namespace rastercheck::rasterizer
