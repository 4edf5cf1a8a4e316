#pragma once

// Serves the route “fragments” (docs/rasterizer.md, Routes).
//
// An evaluated block, and an output that appends it to a list of fragments.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A block's values at one sample index of its pixels.
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

/// A block with the values of all its samples.
struct EvaluatedBlock {
  std::uint32_t triangle = 0;
  int y = 0;
  int first = 0;     ///< pixel of bit 0
  Mask touched = 0;  ///< pixels with at least one covered sample
  std::span<const SampleBlock> samples;
  /// [sample][column][attribute]; empty without State::derivatives.
  std::span<const Slopes> derivatives;
};

/// Appends the covered samples to fragments.
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

}  // namespace rastercheck::rasterizer
