// lines: of every mode and width, long and short, along axes and diagonals, with ends at samples,
// borders of pixels and corners of diamonds, beyond the viewport, the depth planes and the eye.

#include <array>

#include "properties/generator.h"
#include "properties/generators/internal/primitive_state.h"
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

/// A place that decides ties: a sample, or a multiple of an eighth of a pixel.
WindowPoint telling_place(Draw& draw, const cases::Case& c) {
  if (draw.one_in(3)) return visible_sample(draw, c);
  const int u = draw.between(-16, 8 * c.framebuffer.width + 16);
  const int v = draw.between(-16, 8 * c.framebuffer.height + 16);
  return {u / 8.0, v / 8.0};
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
    const float depth = random_depth(draw, c);
    const float w = is_level ? 1.0F : random_weight(draw);
    ends[i] = at_window(c, points[i], depth, w);
  }
  if (draw.one_in(12)) {  // behind the eye, or beyond a depth plane
    cases::ClipVertex& end = ends[draw.one_in(2) ? 0 : 1];
    if (draw.one_in(2)) {
      end.w = -end.w;
    } else {
      end.z = draw.uniform(-3, 3);
    }
  }
  const std::uint32_t first = add_vertex(c, ends[0]);
  const std::uint32_t second = add_vertex(c, ends[1]);
  c.triangles.push_back({first, second, second});
}

cases::Case make(Draw& draw) {
  const bool is_on_grid = draw.one_in(2);
  cases::Case c = random_primitive_state(draw, cases::Primitive::lines, is_on_grid);
  set_line_mode(draw, c);
  const int lines = draw.between(2, 4 + draw.size() / 16);
  for (int i = 0; i < lines; ++i) add_line(draw, c);
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration({"lines",
                                           "lines of every mode and width, clipped ones included",
                                           &make, false});

}  // namespace
}  // namespace rastercheck::properties::lines_generator
