#include "rasterizer/internal/tile.h"

#include <algorithm>

namespace rastercheck::rasterizer {

namespace {

/// Size in floats of the largest framebuffer that the caches may hold: 8 MiB, a core's likely share
/// of a cache.
constexpr std::size_t kMostCached = (std::size_t{8} << 20) / sizeof(float);

}  // namespace

Tile::Tile(int samples, std::size_t attribute_count, bool has_words)
    : samples_(static_cast<std::size_t>(samples)),
      attribute_count_(has_words ? 1 : attribute_count),
      has_words_(has_words),
      values_((1 + attribute_count_) * stride()) {
  for (std::size_t s = 0; s < samples_; ++s) {
    depth_arrays_.push_back(depths(s));
    for (std::size_t a = 0; a < attribute_count_; ++a) attribute_arrays_.push_back(values(a, s));
  }
}

void Tile::move_to(const Picture& framebuffer, int column, int row) {
  columns_ = {column * kTileSize, std::min((column + 1) * kTileSize, framebuffer.size.width)};
  rows_ = {row * kTileSize, std::min((row + 1) * kTileSize, framebuffer.size.height)};
}

void Tile::clear(const Picture& framebuffer, int column, int row, float depth) {
  move_to(framebuffer, column, row);
  is_cleared_ = true;
  float* const attributes = values(0, 0);
  std::fill(values_.data(), attributes, depth);
  std::fill(attributes, values_.data() + values_.size(), 0.0F);
}

std::size_t Tile::first_pixel(const Picture& framebuffer) const {
  return static_cast<std::size_t>(rows_.begin) * static_cast<std::size_t>(framebuffer.size.width) +
         static_cast<std::size_t>(columns_.begin);
}

TileRows Tile::rows_of(std::span<float* const> arrays, const Picture& framebuffer) const {
  return {arrays, static_cast<std::size_t>(columns_.end - columns_.begin),
          static_cast<std::size_t>(rows_.end - rows_.begin),
          static_cast<std::size_t>(framebuffer.size.width), false};
}

void Tile::load(const Picture& framebuffer, int column, int row) {
  move_to(framebuffer, column, row);
  is_cleared_ = false;
  const std::size_t first = first_pixel(framebuffer);
  const TileRows depths = rows_of(depth_arrays_, framebuffer);
  const TileRows attributes = rows_of(attribute_arrays_, framebuffer);
  separate(framebuffer.depth.data() + first * depths.arrays.size(), depths);
  if (framebuffer.format == ColorFormat::rgba8) {
    const std::uint8_t* const bytes = framebuffer.bytes.data() + first * samples_ * 4;
    has_words_ ? separate_words(bytes, attributes) : separate(bytes, attributes);
  } else {
    separate(framebuffer.attributes.data() + first * attributes.arrays.size(), attributes);
  }
}

void Tile::store(Picture& framebuffer) const {
  const std::size_t first = first_pixel(framebuffer);
  const bool is_cached = framebuffer.depth.size() + framebuffer.attributes.size() <= kMostCached;
  TileRows depths = rows_of(depth_arrays_, framebuffer);
  TileRows attributes = rows_of(attribute_arrays_, framebuffer);
  depths.streams = attributes.streams = is_cleared_ && !is_cached;
  interleave(depths, framebuffer.depth.data() + first * depths.arrays.size());
  if (framebuffer.format == ColorFormat::rgba8) {
    std::uint8_t* const bytes = framebuffer.bytes.data() + first * samples_ * 4;
    has_words_ ? interleave_words(attributes, bytes) : interleave(attributes, bytes);
  } else {
    interleave(attributes, framebuffer.attributes.data() + first * attributes.arrays.size());
  }
}

}  // namespace rastercheck::rasterizer
