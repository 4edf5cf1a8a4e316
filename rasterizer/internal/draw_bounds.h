#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The samples that a draw may touch: those inside the target, the scissor and the viewport.

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

/// Returns the pixels i of `range` with low <= i + offset < high; `low` and `high` are in pixels.
/// Exact if range.begin >= 0 and 0 <= offset < 1 is a multiple of 1/16: low − offset is then either
/// exact or within (−1, 0), where its rounding changes no pixel. Empty if `low` or `high` is NaN.
PixelRange pixels_from_to(const PixelRange& range, double offset, double low, double high);

/// Does the same for low <= i + offset <= high.
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
  // For conservative coverage, where sample_columns and sample_rows are alike for all samples: the
  // pixels whose open square meets the viewport (Conservative::outer) or lies in it (inner).
  PixelRange whole_columns;  ///< pixels that lie in the viewport
  PixelRange whole_rows;
};

/// Returns the bounds of a draw. The viewport limits samples of triangles, to [origin, origin +
/// size) after sorting its ends; target and scissor limit pixels.
DrawBounds draw_bounds(const State& state, const TargetSize& size);
/// Returns the bounds that the draw would have without its scissor.
DrawBounds draw_bounds_of_window(const State& state, const TargetSize& size);

}  // namespace rastercheck::rasterizer
