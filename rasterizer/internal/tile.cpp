#include "rasterizer/internal/tile.h"

#include <algorithm>
#include <utility>

namespace rastercheck::rasterizer {

namespace {

/// Of framebuffers, in numbers: 8 MiB, what a core may have of a cache that it shares.
constexpr std::size_t kMostCached = (std::size_t{8} << 20) / sizeof(float);

}  // namespace

Tile::Tile(int samples, std::size_t attribute_count)
    : samples_(static_cast<std::size_t>(samples)),
      attribute_count_(attribute_count),
      values_((1 + attribute_count) * stride()) {
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
  is_cleared_ = true;
  float* const attributes = values(0, 0);
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
          static_cast<std::size_t>(framebuffer.size.width) * arrays.size(), false};
}

void Tile::load(const Framebuffer& framebuffer, int column, int row) {
  move_to(framebuffer, column, row);
  is_cleared_ = false;
  const std::size_t first = first_pixel(framebuffer);
  for (const auto& [arrays, values] :
       {std::pair(&depth_arrays_, framebuffer.depth.data()),
        std::pair(&attribute_arrays_, framebuffer.attributes.data())}) {
    separate(values + first * arrays->size(), rows_of(*arrays, framebuffer));
  }
}

void Tile::store(Framebuffer& framebuffer) const {
  const std::size_t first = first_pixel(framebuffer);
  const bool is_cached = framebuffer.depth.size() + framebuffer.attributes.size() <= kMostCached;
  for (const auto& [arrays, values] :
       {std::pair(&depth_arrays_, framebuffer.depth.data()),
        std::pair(&attribute_arrays_, framebuffer.attributes.data())}) {
    TileRows rows = rows_of(*arrays, framebuffer);
    rows.streams = is_cleared_ && !is_cached;
    interleave(rows, values + first * arrays->size());
  }
}

}  // namespace rastercheck::rasterizer
