// huge: triangles that reach far beyond the screen, the guard band and 2^31 pixels; weights that
// differ by up to 2^40; positions close to the largest floats. Integers overflow here, edges are
// steep, and only a small part of the whole is on screen.

#include <algorithm>
#include <array>
#include <cstdint>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::huge_generator {
namespace {

/// Returns a vertex's distance in pixels: a power of two, exactly or up to a pixel off, or any
/// number between powers of two.
double random_distance(Draw& draw) {
  const int exponent = draw.pick(std::array{9, 12, 14, 15, 16, 20, 24, 28, 31, 31, 32});
  const auto power = static_cast<double>(std::uint64_t{1} << exponent);
  switch (draw.between(0, 3)) {
    case 0:
      return power;
    case 1: {
      const int more = draw.between(-1, 1);
      return power + static_cast<double>(more);
    }
    default:
      return power * (1 + double{draw.unit()});
  }
}

/// A direction whose larger component is ±1; often axis-aligned or diagonal.
WindowPoint random_direction(Draw& draw) {
  if (draw.one_in(3)) {
    const int u = draw.between(-1, 1);
    const int v = u == 0 ? 1 : draw.between(-1, 1);
    return {static_cast<double>(u), static_cast<double>(v)};
  }
  const double other = double{draw.uniform(-1, 1)};
  const double sign = draw.one_in(2) ? 1.0 : -1.0;
  if (draw.one_in(2)) return {sign, other};
  return {other, sign};
}

/// Returns three points around `middle`. The third direction is opposite to a direction between the
/// first two, so that the triangle contains `middle`.
std::array<WindowPoint, 3> around(Draw& draw, const WindowPoint& middle) {
  const WindowPoint a = random_direction(draw);
  const WindowPoint b = random_direction(draw);
  const double s = 0.25 + double{draw.unit()};
  const double t = 0.25 + double{draw.unit()};
  const std::array directions{a, b, WindowPoint{-(s * a.u + t * b.u), -(s * a.v + t * b.v)}};
  const double common = random_distance(draw);
  const bool is_even = draw.one_in(2);
  std::array<WindowPoint, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_near = draw.one_in(4);
    const double distance = is_near ? 8.0 : (is_even ? common : random_distance(draw));
    points[i] = {middle.u + distance * directions[i].u, middle.v + distance * directions[i].v};
  }
  return points;
}

/// A positive weight from 2^-reach to 2^reach.
float random_weight(Draw& draw, int reach) {
  const float w = draw.spread(-reach, reach - 1);
  return w < 0 ? -w : w;
}

/// Multiplies all positions by 2^20, 2^60, 2^100 or 2^126; if a coordinate would reach 2^127, by
/// the largest smaller power of two for which none does.
void scale_up(Draw& draw, cases::Case& c) {
  float most = 0;
  for (const cases::ClipVertex& p : c.positions) {
    for (const float coordinate : {p.x, p.y, p.z, p.w}) {
      most = std::max({most, coordinate, -coordinate});
    }
  }
  float factor = draw.pick(std::array{0x1p20F, 0x1p60F, 0x1p100F, 0x1p126F});
  while (double{most} * double{factor} >= 0x1p127) factor /= 2;
  for (cases::ClipVertex& p : c.positions) {
    p = {p.x * factor, p.y * factor, p.z * factor, p.w * factor};
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 40;  // many of these triangles fill the framebuffer
  cases::Case c = random_state(draw, request);
  const int triangles = draw.between(1, 1 + draw.size() / 40);
  const bool has_equal_weights = draw.one_in(3);
  const int reach = draw.pick(std::array{1, 4, 10, 20});
  for (int i = 0; i < triangles; ++i) {
    const WindowPoint middle = draw.one_in(2) ? visible_sample(draw, c) : visible_point(draw, c);
    const std::array<WindowPoint, 3> points = around(draw, middle);
    const bool is_tilted = draw.one_in(3);
    const float plane = random_depth(draw, c);
    std::array<cases::ClipVertex, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const float w = has_equal_weights ? 1.0F : random_weight(draw, reach);
      const float depth = is_tilted ? random_depth(draw, c) : plane;
      corners[k] = at_window(c, points[k], depth, w);
    }
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
  if (draw.one_in(4)) scale_up(draw, c);
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"huge", "triangles that reach to 2^31 pixels and farther, w ratios up to 2^40", &make});

}  // namespace
}  // namespace rastercheck::properties::huge_generator
