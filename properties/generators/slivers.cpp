// slivers: triangles whose corners are close to one line. A sample's weights in them are quotients
// of small differences, and an attribute may run through its whole range within a fraction of a
// pixel.

#include <algorithm>
#include <array>
#include <utility>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::slivers_generator {
namespace {

/// Returns the ends of a sliver: across the screen, between two samples, along a row or column, or
/// a few pixels apart.
std::array<WindowPoint, 2> random_ends(Draw& draw, const cases::Case& c) {
  switch (draw.between(0, 3)) {
    case 0: {
      const WindowPoint a = point_about(draw, c);
      const WindowPoint b = point_about(draw, c);
      return {a, b};
    }
    case 1: {
      const WindowPoint a = visible_sample(draw, c);
      const WindowPoint b = visible_sample(draw, c);
      return {a, b};
    }
    case 2: {  // along a row or a column of samples, to both sides of a sample
      const WindowPoint p = visible_sample(draw, c);
      const double length = static_cast<double>(draw.between(1, 80));
      if (draw.one_in(2)) return {WindowPoint{p.u - length, p.v}, WindowPoint{p.u + length, p.v}};
      return {WindowPoint{p.u, p.v - length}, WindowPoint{p.u, p.v + length}};
    }
    default: {
      const WindowPoint a = visible_sample(draw, c);
      const double du = double{draw.uniform(-4, 4)};
      const double dv = double{draw.uniform(-4, 4)};
      return {a, WindowPoint{a.u + du, a.v + dv}};
    }
  }
}

void add_sliver(Draw& draw, cases::Case& c) {
  const std::array<WindowPoint, 2> ends = random_ends(draw, c);
  const double along_u = ends[1].u - ends[0].u;
  const double along_v = ends[1].v - ends[0].v;

  // The third corner lies at `t` along the line. Its distance from the line ranges from mere
  // rounding error to about a pixel.
  const double place = draw.pick(std::array{0.0, 0.25, 0.5, 1.0, 2.0});
  const double t = place + double{draw.unit()} / 4;
  const double thickness =
      draw.one_in(5) ? 0.0 : power_of_two(-draw.between(0, 2 + draw.size() / 4));
  // Takes the larger component as the length, which avoids a square root and is at most a factor of
  // √2 too small.
  const double length = std::max({along_u, -along_u, along_v, -along_v, 0x1p-20});
  const double off = thickness / length;
  const WindowPoint third{ends[0].u + t * along_u - off * along_v,
                          ends[0].v + t * along_v + off * along_u};

  const bool is_flat_on = draw.one_in(3);
  const float depth = random_depth(draw, c);
  std::array<cases::ClipVertex, 3> corners;
  const std::array points{ends[0], ends[1], third};
  for (std::size_t i = 0; i < 3; ++i) {
    const float w = is_flat_on ? 1.0F : draw.uniform(0.125F, 4);
    const float own_depth = draw.one_in(2) ? depth : random_depth(draw, c);
    corners[i] = at_window(c, points[i], own_depth, w);
  }
  if (draw.one_in(2)) std::swap(corners[1], corners[2]);
  add_triangle(c, corners[0], corners[1], corners[2]);
}

/// Adds a triangle with an edge exactly through a sample and the third corner within a few floats
/// of the edge. Coordinates have up to 24 bits, so that no double holds the edge function's value.
/// In homogeneous coordinates, which need no division, the sample is `q` and the edge's ends are
/// `a` and `q − a`.
void add_slender_triangle(Draw& draw, cases::Case& c) {
  const WindowPoint p = visible_sample(draw, c);
  const double width{c.viewport.width};
  const double height{c.viewport.height};
  const double side = c.rules == cases::Rules::d3d ? -1 : 1;
  const double sign = width * height < 0 ? -1 : 1;
  const double q_x = sign * (2 * (p.u - double{c.viewport.x}) - width) * height;
  const double q_y = sign * side * (2 * (p.v - double{c.viewport.y}) - height) * width;
  const double q_w = sign * width * height;

  // The coordinates of `a` are multiples of 2^-11, as are those of `q` if the viewport's numbers
  // are integers. They are below 2^13 (24 bits), except in viewports of thousands of pixels, where
  // the ends are farther apart.
  const auto most = static_cast<int>(std::min(q_w * 0x1p11, 0x1p30));
  const int n_w = draw.between(most / 8, most - most / 8);
  const int n_x = draw.between(-n_w, n_w);
  const int n_y = draw.between(-n_w, n_w);
  const float depth = random_depth(draw, c);
  const auto corner = [depth](double x, double y, double w) {
    return cases::ClipVertex{to_float(x), to_float(y), to_float(double{depth} * w), to_float(w)};
  };
  const double a_x = n_x * 0x1p-11;
  const double a_y = n_y * 0x1p-11;
  const double a_w = n_w * 0x1p-11;
  const double s = double{draw.unit()};
  const auto between = [s](double a, double q) { return s * a + (1 - s) * (q - a); };
  cases::ClipVertex third = corner(between(a_x, q_x), between(a_y, q_y), between(a_w, q_w));
  third.x = stepped(third.x, draw.between(-2, 2));
  third.y = stepped(third.y, draw.between(-2, 2));
  add_triangle(c, corner(a_x, a_y, a_w), corner(q_x - a_x, q_y - a_y, q_w - a_w), third);
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.least_side = 24;
  cases::Case c = random_state(draw, request);
  const int triangles = draw.between(6, 10 + draw.size() / 8);
  for (int i = 0; i < triangles; ++i) {
    if (draw.one_in(3)) {
      add_slender_triangle(draw, c);
    } else {
      add_sliver(draw, c);
    }
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"slivers", "triangles whose corners are close to one line, long and short", &make});

}  // namespace
}  // namespace rastercheck::properties::slivers_generator
