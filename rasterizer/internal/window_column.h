#pragma once

// Serves lines and points (primitive_drawing.h).
//
// Vertices in homogeneous coordinates of the window, without rounding.
//
// Exponents. Twice a window position times w is N of grid_position.h, a sum of products of two
// floats. A line's direction is one of three floats, as the products with the viewport's origin
// cancel (line_shape.h), its end functionals are one of five, and with r w or z and the depth range
// one of seven (primitive_values.h): multiples of 2^-1050 below 2^930. A double has them all.

#include <array>
#include <glm/vec4.hpp>

#include "rasterizer/internal/exact_plane.h"
#include "rasterizer/internal/exact_sum.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A vertex at the window position at/w in half pixels.
struct WindowColumn {
  std::array<ExactSum, 2> at;
  ExactSum w;

  /// at/w in double; w must be positive. Off by a few 2^-52 of itself.
  HalfPixels near() const;
};

/// The column of a clip position.
WindowColumn window_column(const State& state, const glm::vec4& position);

/// The column of a clip position that is rounded to State::snapping's grid, with w = 1. The
/// position must be within the guard band (grid_position.h).
WindowColumn snapped_column(const State& state, const glm::vec4& position);

}  // namespace rastercheck::rasterizer
