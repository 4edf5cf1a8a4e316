// wide: framebuffers more than 64 pixels wide and only a few rows high. Rasterizers process pixels
// in blocks, tiles or mask words; a bug in any but a row's first block shows here.

#include <array>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::wide_generator {
namespace {

/// A point anywhere, so that triangles' rows begin and end anywhere in their blocks. One point in
/// three may lie outside the framebuffer.
WindowPoint random_point(Draw& draw, const cases::Case& c) {
  if (draw.one_in(3)) return point_about(draw, c);
  if (draw.one_in(2)) return visible_sample(draw, c);
  return visible_point(draw, c);
}

/// Adds a triangle with equal or different weights.
void add_free(Draw& draw, cases::Case& c) {
  const bool is_flat_on = draw.one_in(3);
  std::array<cases::ClipVertex, 3> corners;
  for (cases::ClipVertex& corner : corners) {
    const WindowPoint p = random_point(draw, c);
    const float depth = random_depth(draw, c);
    const float w = is_flat_on ? 1.0F : draw.uniform(0.125F, 4);
    corner = at_window(c, p, depth, w);
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

/// Adds a triangle along the rows, from near one side to near the other and at most a few pixels
/// high.
void add_streak(Draw& draw, cases::Case& c) {
  const auto end = static_cast<double>(c.framebuffer.width);
  const WindowPoint middle = visible_sample(draw, c);
  std::array<WindowPoint, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    const double beside = double{draw.uniform(-8, 8)};
    const double above = double{draw.uniform(-2, 2)};
    points[i] = {(i == 0 ? 0 : end) + beside, middle.v + above};
  }
  const float depth = random_depth(draw, c);
  const bool is_flat_on = draw.one_in(2);
  std::array<cases::ClipVertex, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const float w = is_flat_on ? 1.0F : draw.uniform(0.25F, 4);
    corners[i] = at_window(c, points[i], depth, w);
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.is_wide = true;
  cases::Case c = random_state(draw, request);
  const int triangles = draw.between(1, 2 + draw.size() / 50);
  for (int i = 0; i < triangles; ++i) {
    if (draw.one_in(2)) {
      add_free(draw, c);
    } else {
      add_streak(draw, c);
    }
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"wide", "targets of 65 to 200 pixels in a row, triangles along it", &make});

}  // namespace
}  // namespace rastercheck::properties::wide_generator
