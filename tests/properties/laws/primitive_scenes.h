#pragma once

// Lines and points for tests of laws, and what is wrong with them.

#include "cases/case.h"

namespace rastercheck::properties {

/// A line from (1, 2) to (7, 2), two pixels wide, w = 1, depth 1/4, in 8 × 8 pixels. Attribute 0 is
/// the window x. Rectangular, it covers the pixels x = 1 to 6 of rows 1 and 2.
inline cases::Case level_line() {
  cases::Case c;
  c.rules = cases::Rules::vulkan;
  c.framebuffer = {8, 8, 1};
  c.viewport.width = 8;
  c.viewport.height = 8;
  c.primitive = cases::Primitive::lines;
  c.line_width = 2;
  c.positions = {{-0.75F, -0.5F, 0.25F, 1}, {0.75F, -0.5F, 0.25F, 1}};
  c.attributes = {{"x", cases::Interpolation::smooth, cases::Location::sample}};
  c.attribute_values = {1, 7};
  c.triangles = {{0, 1, 1}};
  return c;
}

/// The same from (1.5, 2.5) to (6.5, 2.5), one pixel wide, by diamonds: the pixels x = 1 to 5 of
/// row 2, as pixel 6 holds the second end.
inline cases::Case bresenham_line() {
  cases::Case c = level_line();
  c.line_mode = cases::LineMode::bresenham;
  c.line_width = 1;
  c.positions = {{-0.625F, -0.375F, 0.25F, 1}, {0.625F, -0.375F, 0.25F, 1}};
  return c;
}

/// Two points of size 2 that touch, at (3, 3) and (5, 3): the pixels x = 2 to 5 of rows 2 and 3.
inline cases::Case two_points() {
  cases::Case c = level_line();
  c.primitive = cases::Primitive::points;
  c.point_size = 2;
  c.positions = {{-0.25F, -0.25F, 0.25F, 1}, {0.25F, -0.25F, 0.25F, 1}};
  c.triangles = {{0, 0, 0}, {1, 1, 1}};
  return c;
}

}  // namespace rastercheck::properties
