// lines: of every mode and width, long and short, along axes and diagonals, with ends at samples,
// borders of pixels and corners of diamonds, beyond the viewport, the depth planes and the eye.

#include <array>
#include <cmath>
#include <utility>

#include "properties/generator.h"
#include "properties/primitive_state.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::lines_generator {
namespace {

/// A point near `p`: a few pixels along an axis, a diagonal or in any direction.
WindowPoint end_near(Draw& draw, const WindowPoint& p) {
  const int length = draw.between(-12, 12);
  const double along = draw.one_in(3) ? length / 16.0 : length;
  switch (draw.between(0, 4)) {
    case 0:
      return {p.u + along, p.v};
    case 1:
      return {p.u, p.v + along};
    case 2:
      return {p.u + along, p.v + along};
    case 3:
      return {p.u + along, p.v - along};
    default: {
      const double across = double{draw.uniform(-6, 6)};
      return {p.u + along, p.v + across};
    }
  }
}

/// A place that decides ties: a sample, a multiple of half a pixel (a corner of a pixel, or of its
/// diamond), or of an eighth.
WindowPoint telling_place(Draw& draw, const cases::Case& c) {
  if (draw.one_in(3)) return visible_sample(draw, c);
  const int parts = draw.one_in(2) ? 2 : 8;
  const int u = draw.between(-2 * parts, parts * (c.framebuffer.width + 2));
  const int v = draw.between(-2 * parts, parts * (c.framebuffer.height + 2));
  return {static_cast<double>(u) / parts, static_cast<double>(v) / parts};
}

float random_weight(Draw& draw) {
  switch (draw.between(0, 3)) {
    case 0:
      return draw.uniform(0.125F, 4);
    case 1:
      return draw.pick(std::array{0.5F, 2.0F, 4.0F});
    default:
      return 1;
  }
}

cases::ClipVertex end_at(Draw& draw, const cases::Case& c, const WindowPoint& p, float w) {
  return at_window(c, p, random_depth(draw, c), w);
}

void add_ends(cases::Case& c, const std::array<cases::ClipVertex, 2>& ends) {
  const std::uint32_t first = add_vertex(c, ends[0]);
  const std::uint32_t second = add_vertex(c, ends[1]);
  c.triangles.push_back({first, second, second});
}

/// Moves the viewport so that its middle, where floats are densest, is a sample.
void center_on_sample(Draw& draw, cases::Case& c) {
  const WindowPoint p = sample_in_pixel(draw, c, visible_middle(c));
  c.viewport.x = static_cast<float>(p.u) - c.viewport.width / 2;
  c.viewport.y = static_cast<float>(p.v) - c.viewport.height / 2;
}

/// A line that is far shorter than a pixel, mostly with a sample between its ends: large terms
/// cancel in its weights.
void add_short_line(Draw& draw, cases::Case& c) {
  WindowPoint p = visible_sample(draw, c);
  int shortest = -20;
  if (draw.one_in(2)) {
    p = {double{c.viewport.x} + double{c.viewport.width} / 2,
         double{c.viewport.y} + double{c.viewport.height} / 2};
    shortest = -45;
  }
  const double length{draw.spread(shortest, -2)};
  WindowPoint along{length, length * double{draw.uniform(-1, 1)}};
  if (draw.one_in(2)) std::swap(along.u, along.v);
  const double share{draw.unit()};
  const float w_a = draw.uniform(0.125F, 4);
  const float w_b = draw.one_in(2) ? w_a : std::abs(draw.spread(-12, 12));
  const WindowPoint a{p.u - share * along.u, p.v - share * along.v};
  const WindowPoint b{a.u + along.u, a.v + along.v};
  const cases::ClipVertex first = end_at(draw, c, a, w_a);
  const cases::ClipVertex second = end_at(draw, c, b, w_b);
  add_ends(c, {first, second});
}

/// A line whose middle, or a side of it, goes exactly through a sample, although no double holds
/// the window positions of its ends. Sides do if the line is no rectangle.
void add_tied_line(Draw& draw, cases::Case& c) {
  WindowPoint p = visible_sample(draw, c);
  const int side = draw.between(-1, 1);
  double& coordinate = draw.one_in(2) ? p.u : p.v;
  coordinate += side * double{c.line_width} / 2;
  const float depth = random_depth(draw, c);
  add_ends(c, edge_through(draw, c, p, depth));
}

void add_line(Draw& draw, cases::Case& c) {
  const bool is_telling = draw.one_in(2);
  const WindowPoint a = is_telling ? telling_place(draw, c) : point_about(draw, c);
  const bool is_far = draw.one_in(3);
  WindowPoint b = end_near(draw, a);
  if (is_far) b = is_telling ? telling_place(draw, c) : point_about(draw, c);
  std::array<cases::ClipVertex, 2> ends;
  const std::array points{a, b};
  const bool is_level = draw.one_in(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const float w = is_level ? 1.0F : random_weight(draw);
    ends[i] = end_at(draw, c, points[i], w);
  }
  if (draw.one_in(12)) {  // behind the eye, or beyond a depth plane
    cases::ClipVertex& end = ends[draw.one_in(2) ? 0 : 1];
    if (draw.one_in(2)) {
      end.w = -end.w;
    } else {
      end.z = draw.uniform(-3, 3);
    }
  }
  add_ends(c, ends);
}

/// Makes some clip distances 0 in the middle between both ends, where a sample may be.
void balance_clip_distances(Draw& draw, cases::Case& c) {
  const std::size_t count = c.clip_distance_count;
  for (const cases::Triangle& line : c.triangles) {
    for (std::size_t d = 0; d < count; ++d) {
      if (draw.one_in(2)) continue;
      c.clip_distances[line[1] * count + d] = -c.clip_distances[line[0] * count + d];
    }
  }
}

cases::Case make(Draw& draw) {
  const bool is_on_grid = draw.one_in(2);
  cases::Case c = random_primitive_state(draw, cases::Primitive::lines, is_on_grid);
  set_line_mode(draw, c);
  if (draw.one_in(8)) center_on_sample(draw, c);
  const bool has_distance = draw.one_in(4);
  if (has_distance && draw.capabilities().has(cases::Feature::clip_distances)) {
    c.clip_distance_count = 1;
  }
  const int lines = draw.between(3, 5 + draw.size() / 16);
  for (int i = 0; i < lines; ++i) {
    switch (draw.between(0, 11)) {
      case 0:
        add_short_line(draw, c);
        break;
      case 1:
        add_tied_line(draw, c);
        break;
      default:
        add_line(draw, c);
    }
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  balance_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration({"lines",
                                           "lines of every mode and width, clipped ones included",
                                           &make, false});

}  // namespace
}  // namespace rastercheck::properties::lines_generator
