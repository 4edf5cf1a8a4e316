#pragma once

// Serves the route “fragments” (docs/rasterizer.md, Routes).
//
// Observers of a draw: the stages show every intermediate result to a Tap. NoTap ignores everything
// and compiles away. RecordingTap records one sample (rasterizer/trace.h). With the drawing's own
// code, it recomputes the unrounded doubles that the drawing discards.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "rasterizer/internal/block_kernels.h"
#include "rasterizer/internal/coverage.h"
#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/float_kernels.h"
#include "rasterizer/internal/grid_position.h"
#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

/// Up to 64 pixels of a row, with one sample index, for a triangle.
struct BlockPlace {
  std::uint32_t triangle = 0;
  std::size_t sample = 0;
  int y = 0;
  int first = 0;
  int count = 0;
};

/// The inputs of a block's values: a part and the part's weights at the samples `drawn`. The
/// samples lie at `offset` in their pixels.
struct WeighedBlock {
  const BlockPlace& place;
  const SampleOffset& offset;
  const DrawnPart& part;
  Mask drawn = 0;
  const BlockWeights& weights;
};

/// A window position at which a value is evaluated, and the part that the value belongs to.
struct PartPoint {
  const DrawnPart& part;
  double u = 0;
  double v = 0;
};

struct NoTap {
  template <typename... Shown>
  static void set_up(const Shown&... /*shown*/) {}
  template <typename... Shown>
  static void covered(const Shown&... /*shown*/) {}
  template <typename... Shown>
  static void weighed(const Shown&... /*shown*/) {}
  template <typename... Shown>
  static void summed(const Shown&... /*shown*/) {}
  template <typename... Shown>
  static void depth(const Shown&... /*shown*/) {}
  template <typename... Shown>
  static void attribute(const Shown&... /*shown*/) {}
  template <typename... Shown>
  static void exact(const Shown&... /*shown*/) {}
  template <typename... Shown>
  static void located(const Shown&... /*shown*/) {}
};

class RecordingTap {
 public:
  explicit RecordingTap(const SamplePlace& address) : address_(address) {}

  /// Called with a triangle and the parts that it is drawn in.
  template <typename Coverage>
  void set_up(const DrawSetting& setting, std::uint32_t triangle, const Coverage& coverage,
              std::span<const DrawnPart> parts) {
    if (triangle != address_.triangle) return;
    const SampleOffset& offset = setting.pattern[static_cast<std::size_t>(address_.sample)];
    trace_.emplace();
    trace_->u = address_.x + offset.x;
    trace_->v = address_.y + offset.y;
    polygon_ = coverage.polygon();
    if (setting.state.snapping) {
      units_of_a_pixel_ = std::ldexp(1.0, unit_bits(*setting.state.snapping));
    }
    if (polygon_ != nullptr) set_corners(coverage.corners_at(trace_->u, trace_->v));
    set_part(parts[coverage.part_at(trace_->u, trace_->v)]);
    if (is_looked_at(setting.bounds, coverage.box())) {
      trace_->decision =
          Coverage::kLeavesWeights ? Decision::in_double : Decision::in_whole_numbers;
    }
  }
  /// Called with coverage and, if Coverage::kLeavesWeights, with the weights that decided it.
  void covered(const BlockPlace& place, const CoveredBlock& block, const BlockWeights& weights);
  void weighed(const WeighedBlock& block);
  /// Called with the row of Σ E_i.
  void summed(const WeighedBlock& block, const PlaneRow& sum);
  /// Called with depth evaluated in double.
  void depth(const WeighedBlock& block, const PlaneRow& row, const float* values);
  /// Called with an attribute that is copied, evaluated in double or, from `shares`, evaluated in
  /// float32.
  void attribute(const WeighedBlock& block, std::size_t attribute, const PlaneRow& row,
                 const FloatWeights& shares, const float* values);
  /// Called with an attribute (or depth, if `attribute` is empty) for which double did not suffice.
  void exact(const BlockPlace& place, int column, std::optional<std::size_t> attribute,
             const PartPoint& at, double evaluated, float value);
  /// Called with an attribute that is evaluated once per pixel.
  void located(const BlockPlace& place, int column, std::size_t attribute, const PartPoint& at,
               double evaluated, float value);

  /// The recorded trace; empty if the triangle was not set up.
  const std::optional<Trace>& trace() const { return trace_; }

 private:
  bool is_at(const BlockPlace& place, Mask mask) const;
  std::size_t column(const BlockPlace& place) const {
    return static_cast<std::size_t>(address_.x - place.first);
  }
  bool is_looked_at(const DrawBounds& bounds, const PixelBox& box) const;
  using Corners = std::optional<std::array<TracedCorner, 3>>;
  /// Sets a part's corners: `snapped` and, if the polygon is cut, `window`, the corners before
  /// snapping.
  void set_corners(const PieceCorners& corners, Corners& window, Corners& snapped) const;
  void set_corners(const PieceCorners& corners) {
    set_corners(corners, trace_->corners, trace_->snapped);
  }
  void set_part(const DrawnPart& part);
  Decision decision_of(const BlockPlace& place, const CoveredBlock& block) const;
  TracedValue value_of(const PartPoint& at) const;
  TracedValue value_of(const WeighedBlock& block) const;

  SamplePlace address_;
  std::optional<Trace> trace_;
  // About the current triangle.
  const GridPolygon* polygon_ = nullptr;
  double units_of_a_pixel_ = 1;      ///< grid units per pixel
  const DrawnPart* part_ = nullptr;  ///< the part that the sample lies in
  double sum_ = 0;                   ///< Σ E_i at the sample
};

}  // namespace rastercheck::rasterizer
