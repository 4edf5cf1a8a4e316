#pragma once

// Where blocks go once their samples have values: into a list of fragments, or into a tile.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/tile.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// What a block holds of one sample of its pixels.
struct SampleBlock {
  CoveredBlock coverage;
  std::array<float, kBlockSize> depth;
  std::array<std::array<float, kBlockSize>, kMaxAttributes> attributes;

  void take(Mask mask, const SampleBlock& other, std::size_t attribute_count) {
    for_each_bit(mask, [&](int j) {
      const auto column = static_cast<std::size_t>(j);
      depth[column] = other.depth[column];
      for (std::size_t a = 0; a < attribute_count; ++a) {
        attributes[a][column] = other.attributes[a][column];
      }
    });
  }
};

/// A block whose samples have their values.
struct EvaluatedBlock {
  std::uint32_t triangle = 0;
  int y = 0;
  int first = 0;     ///< pixel of bit 0
  Mask touched = 0;  ///< pixels of which some sample is covered
  std::span<const SampleBlock> samples;
  /// [sample][column][attribute]; none without State::derivatives.
  std::span<const Slopes> derivatives;
};

/// Appends what was drawn to fragments.
class FragmentOutput {
 public:
  FragmentOutput(Fragments& fragments, std::size_t attributes)
      : fragments_(fragments), attributes_(attributes) {}

  void take(const EvaluatedBlock& block) {
    const std::size_t at = fragments_.size();
    std::size_t end = at;
    for (const SampleBlock& sample : block.samples) {
      end += static_cast<std::size_t>(std::popcount(sample.coverage.covered));
    }
    fragments_.triangle.resize(end, block.triangle);
    fragments_.x.resize(end);
    fragments_.y.resize(end, static_cast<std::uint16_t>(block.y));
    fragments_.sample.resize(end);
    fragments_.depth.resize(end);
    fragments_.attributes.resize(end * attributes_);
    if (!block.derivatives.empty()) fragments_.derivatives.resize(end * attributes_ * 2);
    put(block, at);
  }

 private:
  void put(const EvaluatedBlock& block, std::size_t at) {
    for_each_bit(block.touched, [&](int j) {
      const auto column = static_cast<std::size_t>(j);
      for (std::size_t s = 0; s < block.samples.size(); ++s) {
        const SampleBlock& sample = block.samples[s];
        if ((sample.coverage.covered >> j & 1) == 0) continue;
        fragments_.x[at] = static_cast<std::uint16_t>(block.first + j);
        fragments_.sample[at] = static_cast<std::uint8_t>(s);
        fragments_.depth[at] = sample.depth[column];
        for (std::size_t a = 0; a < attributes_; ++a) {
          fragments_.attributes[at * attributes_ + a] = sample.attributes[a][column];
        }
        if (!block.derivatives.empty()) put_derivatives(block, s * kBlockSize + column, at);
        ++at;
      }
    });
  }

  void put_derivatives(const EvaluatedBlock& block, std::size_t place, std::size_t at) {
    for (std::size_t a = 0; a < attributes_; ++a) {
      const Slopes& slopes = block.derivatives[place * attributes_ + a];
      std::copy_n(slopes.data(), 2, fragments_.derivatives.data() + (at * attributes_ + a) * 2);
    }
  }

  Fragments& fragments_;
  std::size_t attributes_;
};

/// Keeps what was drawn in a tile, by the depth test.
class TileOutput {
 public:
  TileOutput(DepthTest test, std::size_t attributes) : test_(test), attributes_(attributes) {}

  void begin(Tile& tile) { tile_ = &tile; }

  void take(const EvaluatedBlock& block) {
    for (std::size_t s = 0; s < block.samples.size(); ++s) {
      const SampleBlock& sample = block.samples[s];
      const int from = block.first - tile_->columns().begin;
      for_each_bit(sample.coverage.covered, [&](int j) {
        float& depth = tile_->depth(s, block.y)[from + j];
        const auto column = static_cast<std::size_t>(j);
        if (test_ == DepthTest::less && !(sample.depth[column] < depth)) return;
        depth = sample.depth[column];
        for (std::size_t a = 0; a < attributes_; ++a) {
          tile_->attribute(a, s, block.y)[from + j] = sample.attributes[a][column];
        }
      });
    }
  }

 private:
  DepthTest test_;
  std::size_t attributes_;
  Tile* tile_ = nullptr;
};

}  // namespace rastercheck::rasterizer
