// guard-band: vertices at the limits of fixed-point numbers, or a float or a subpixel to either
// side. One limit is the guard band at 2^15 pixels from the window's origin; at the other limits,
// positions of a given bit width, or their products, would need one bit more. The triangles still
// cover pixels near the origin.

#include <array>
#include <cstdint>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::guard_band_generator {
namespace {

/// Returns ± a power of two in pixels, sometimes off by up to a subpixel of 2^-8 pixels. The
/// largest number of a bit width is one subpixel below such a power. Signed numbers of 16 and 32
/// bits reach 2^7 and 2^23 with 8 bits after the point, and 2^15 and 2^31 without. Floats hold all
/// whole numbers up to 2^24. Framebuffers often reach 2^13 or 2^14 pixels. In edge functions, a
/// product of two differences reaches 2^24 for coordinates up to 2^11 and 2^32 for coordinates up
/// to 2^15; a product of two coordinates up to 2^16 reaches 2^32.
double random_limit(Draw& draw) {
  const int exponent = draw.pick(std::array{15, 15, 15, 15, 7, 11, 13, 14, 16, 23, 24, 31});
  const auto power = static_cast<double>(std::uint64_t{1} << exponent);
  const double less = draw.pick(std::array{0.0, 0.0, 0x1p-8, -0x1p-8, 0x1p-9});
  return draw.one_in(2) ? power - less : less - power;
}

/// Moves a coordinate by about one float in a third of the calls.
void nudge_coordinate(Draw& draw, float& coordinate) {
  if (draw.one_in(3)) coordinate = float_near(draw, coordinate, 1);
}

cases::ClipVertex random_vertex(Draw& draw, const cases::Case& c, bool is_far, float depth) {
  WindowPoint p = draw.one_in(2) ? visible_sample(draw, c) : point_about(draw, c);
  if (is_far) {
    const int axes = draw.between(1, 3);
    if ((axes & 1) != 0) p.u = random_limit(draw);
    if ((axes & 2) != 0) p.v = random_limit(draw);
  }
  const float w = draw.pick(std::array{1.0F, 1.0F, 0.5F, 4.0F, 3.0F});
  cases::ClipVertex vertex = at_window(c, p, depth, w);
  if (is_far) {
    nudge_coordinate(draw, vertex.x);
    nudge_coordinate(draw, vertex.y);
  }
  return vertex;
}

/// Adds a triangle around the screen with all corners at the same limit.
void add_surrounding(Draw& draw, cases::Case& c, float depth) {
  const double limit = random_limit(draw);
  const double size = limit < 0 ? -limit : limit;
  const bool is_upright = draw.one_in(2);
  const double sign = draw.one_in(2) ? 1 : -1;
  const double side = double{draw.uniform(-1, 1)} * size;
  constexpr std::array<WindowPoint, 3> kCorners{{{-1, -1}, {1, -1}, {0, 1}}};
  std::array<cases::ClipVertex, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const double across = i == 2 ? side : kCorners[i].u * size;
    const double along = sign * kCorners[i].v * size;
    const WindowPoint p = is_upright ? WindowPoint{along, across} : WindowPoint{across, along};
    corners[i] = at_window(c, p, depth, 1);
    nudge_coordinate(draw, corners[i].x);
    nudge_coordinate(draw, corners[i].y);
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.is_on_grid = !draw.one_in(3);
  request.most_side = 24;  // many of these triangles fill the framebuffer
  cases::Case c = random_state(draw, request);
  if (draw.one_in(2)) {
    c.coverage = cases::Snapping{8, cases::Rounding::nearest_even, 0};
    c.basis = draw.pick(std::array{cases::Basis::ideal, cases::Basis::snapped});
  }
  const int triangles = draw.between(2, 4 + draw.size() / 25);
  for (int i = 0; i < triangles; ++i) {
    const float depth = random_depth(draw, c);
    if (draw.one_in(4)) {
      add_surrounding(draw, c, depth);
      continue;
    }
    const int far = draw.between(1, 2);
    std::array<cases::ClipVertex, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = random_vertex(draw, c, static_cast<int>(k) < far, depth);
    }
    const auto first = static_cast<std::size_t>(draw.between(0, 2));
    add_triangle(c, corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]);
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"guard-band", "vertices at 2^15 pixels and other limits of fixed point, or one float away",
     &make});

}  // namespace
}  // namespace rastercheck::properties::guard_band_generator
