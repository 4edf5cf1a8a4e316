#pragma once

// Maps clip space to homogeneous window coordinates (RULES §1), in double.

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A window position times w.
struct Numerators {
  double x = 0;
  double y = 0;
};

class WindowMap {
 public:
  explicit WindowMap(const State& state)
      : half_width_(double{state.viewport.size.x} / 2),
        half_height_(double{state.viewport.size.y} /
                     (state.convention == Convention::d3d ? -2 : 2)),
        center_u_(double{state.viewport.origin.x} + double{state.viewport.size.x} / 2),
        center_v_(double{state.viewport.origin.y} + double{state.viewport.size.y} / 2) {}

  /// Maps the clip position (x, y, w), with the window's origin at (u, v) pixels.
  Numerators operator()(double x, double y, double w, double u = 0, double v = 0) const {
    return {x * half_width_ + w * (center_u_ - u), y * half_height_ + w * (center_v_ - v)};
  }

 private:
  double half_width_;
  double half_height_;
  double center_u_;
  double center_v_;
};

}  // namespace rastercheck::rasterizer
