#pragma once

// Serves points (primitive_drawing.h).
//
// The samples of the square around a vertex, as exact arithmetic decides. With (X, w) the vertex
// as a window column (window_column.h), p is in the square iff |2u w − X| <= size · w, and the
// same along v; samples on a side belong to it by the fill rule.

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/exact_plane.h"
#include "rasterizer/internal/window_column.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

class PointShape {
 public:
  /// The column's w must be positive. `tie_sign` is that of DrawSetting.
  PointShape(const State& state, const WindowColumn& center, int tie_sign);

  bool covers(const HalfPixels& p) const;
  /// The pixels that may have covered samples: all of them, and a few more.
  PixelBox box(const PixelBox& bounds) const;

 private:
  int compare_with_size(std::size_t axis, double position, int& side) const;

  WindowColumn center_;
  HalfPixels near_;
  double size_;
  int tie_sign_;
};

}  // namespace rastercheck::rasterizer
