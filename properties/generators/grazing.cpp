// grazing: vertices exactly on the clip planes and the viewport's borders, and one float inside or
// outside them; user clip distances that are zero. The last bit decides whether a triangle is
// clipped at all, and neighbours must not disagree.

#include <array>
#include <cstdint>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::grazing_generator {
namespace {

/// Returns a coordinate over w that lies on the plane at `lo` or `hi`, between the planes, or
/// beyond. ±1 stays exact when multiplied by w.
float about_planes(Draw& draw, float lo, float hi) {
  switch (draw.between(0, 5)) {
    case 0:
      return lo;
    case 1:
      return hi;
    case 2:
      return draw.uniform(lo - 1, hi + 1);
    default:
      return draw.uniform(lo, hi);
  }
}

/// Returns `ratio` times w, sometimes moved by a float.
float weighted(Draw& draw, float ratio, float w) {
  const float exact = to_float(double{ratio} * double{w});
  return draw.one_in(4) ? nudged(draw, exact) : exact;
}

cases::ClipVertex random_vertex(Draw& draw, const cases::Case& c, bool has_unit_weights) {
  const float w = has_unit_weights ? 1.0F : draw.uniform(0.125F, 4);
  const float x = about_planes(draw, -1, 1);
  const float y = about_planes(draw, -1, 1);
  const float z = about_planes(draw, near_depth(c), 1);
  const float clip_x = weighted(draw, x, w);
  const float clip_y = weighted(draw, y, w);
  const float clip_z = weighted(draw, z, w);
  return {clip_x, clip_y, clip_z, w};
}

float random_distance(Draw& draw) {
  switch (draw.between(0, 5)) {
    case 0:
    case 1:
      return draw.one_in(2) ? -0.0F : 0.0F;
    case 2:
      return draw.pick(std::array{0x1p-149F, -0x1p-149F, 0x1p-126F, -0x1p-126F});
    default:
      return draw.uniform(-0.5F, 1);
  }
}

/// Sets distances with many zeros. A third of the cases also get a copy of every vertex and
/// triangle with negated distances; with one distance per vertex, a triangle and its copy together
/// draw every sample once.
void add_grazing_distances(Draw& draw, cases::Case& c) {
  const std::size_t count = c.clip_distance_count;
  c.clip_distances.clear();
  for (std::size_t i = 0; i < c.positions.size() * count; ++i) {
    const float distance = random_distance(draw);
    c.clip_distances.push_back(distance);
  }
  if (count == 0 || !draw.one_in(3)) return;
  const auto vertices = static_cast<std::uint32_t>(c.positions.size());
  const std::size_t triangles = c.triangles.size();
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const cases::ClipVertex position = c.positions[v];
    add_vertex(c, position);
    for (std::size_t d = 0; d < count; ++d)
      c.clip_distances.push_back(-c.clip_distances[v * count + d]);
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    const cases::Triangle triangle = c.triangles[t];
    c.triangles.push_back({triangle[0] + vertices, triangle[1] + vertices, triangle[2] + vertices});
  }
}

/// Moves the borders of the viewport into the framebuffer, by up to an eighth of its size, in
/// halves of a pixel, so that drawing outside the viewport would show.
void inset_viewport(Draw& draw, cases::Case& c) {
  const int most_u = c.framebuffer.width / 4;
  const int most_v = c.framebuffer.height / 4;
  const int halves_u = draw.between(1, most_u);
  const int halves_v = draw.between(1, most_v);
  const float inset_u = static_cast<float>(halves_u) / (c.viewport.width < 0 ? -2.0F : 2.0F);
  const float inset_v = static_cast<float>(halves_v) / (c.viewport.height < 0 ? -2.0F : 2.0F);
  c.viewport.x += inset_u;
  c.viewport.width -= 2 * inset_u;
  c.viewport.y += inset_v;
  c.viewport.height -= 2 * inset_v;
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 44;
  request.has_clip_distances = false;
  cases::Case c = random_state(draw, request);
  c.depth_clamp = draw.one_in(16);
  if (draw.one_in(3)) c.clip_distance_count = static_cast<std::size_t>(draw.between(1, 3));
  if (draw.one_in(2)) inset_viewport(draw, c);
  const int triangles = draw.between(1, 2 + draw.size() / 50);
  const bool has_unit_weights = draw.one_in(2);
  for (int i = 0; i < triangles; ++i) {
    const cases::ClipVertex first = random_vertex(draw, c, has_unit_weights);
    const cases::ClipVertex second = random_vertex(draw, c, has_unit_weights);
    const cases::ClipVertex third = random_vertex(draw, c, has_unit_weights);
    add_triangle(c, first, second, third);
  }
  add_grazing_distances(draw, c);
  add_attribute_values(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"grazing", "vertices exactly on clip planes and viewport borders, or one float away", &make});

}  // namespace
}  // namespace rastercheck::properties::grazing_generator
