#pragma once

// Which samples a draw may touch at all: those within target, scissor and viewport.

#include <array>

#include "rasterizer/internal/standard_pattern.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Indices i with begin <= i < end.
struct PixelRange {
  int begin = 0;
  int end = 0;
  bool empty() const { return begin >= end; }
  bool contains(int i) const { return begin <= i && i < end; }
};

PixelRange intersection(const PixelRange& a, const PixelRange& b);

/// The pixels i of `range` with low <= i + offset < high, both ends in pixels. Exact where
/// range.begin >= 0 and 0 <= offset < 1 is a multiple of 1/16: low − offset is then either exact or
/// within (−1, 0), where its rounding changes no pixel. Empty where an end is not a number.
PixelRange pixels_from_to(const PixelRange& range, double offset, double low, double high);

/// The same with low <= i + offset <= high.
PixelRange pixels_from_through(const PixelRange& range, double offset, double low, double high);

struct PixelBox {
  PixelRange columns;
  PixelRange rows;
};

struct DrawBounds {
  static constexpr std::size_t kMaxSamples = 16;
  PixelRange columns;  ///< target ∩ scissor
  PixelRange rows;
  std::array<PixelRange, kMaxSamples> sample_columns;  ///< [sample]: viewport ∩ columns
  std::array<PixelRange, kMaxSamples> sample_rows;
};

/// The viewport counts per sample, [origin, origin + size) after sorting its ends; target and
/// scissor per pixel.
DrawBounds draw_bounds(const State& state, const TargetSize& size);
/// The same without a scissor.
DrawBounds draw_bounds_of_window(const State& state, const TargetSize& size);

}  // namespace rastercheck::rasterizer
