// through-eye: triangles that reach behind the eye, pass through it, or end a float's breadth from
// it. Some w_i are <= 0. Dividing by a negative w mirrors a vertex, and clipping at the near plane
// turns the triangle into another polygon.

#include <array>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::through_eye_generator {
namespace {

/// A weight that is zero or tiny, of either sign.
float weight_about_zero(Draw& draw) {
  const float magnitude =
      draw.pick(std::array{0.0F, 0.0F, 0x1p-149F, 0x1p-126F, 0x1p-60F, 0x1p-24F, 0x1p-12F});
  return draw.one_in(2) ? -magnitude : magnitude;
}

float random_weight(Draw& draw) {
  switch (draw.between(0, 4)) {
    case 0:
      return weight_about_zero(draw);
    case 1:
    case 2:
      return draw.uniform(-2, 0);
    default:
      return draw.uniform(0, 2);
  }
}

cases::ClipVertex random_vertex(Draw& draw, float w) {
  const float x = draw.uniform(-2, 2);
  const float y = draw.uniform(-2, 2);
  return {x, y, 0, w};
}

/// Returns three vertices in front of or behind the eye, at least one of them in front.
std::array<cases::ClipVertex, 3> scattered(Draw& draw) {
  std::array<cases::ClipVertex, 3> corners;
  for (cases::ClipVertex& corner : corners) {
    const float w = random_weight(draw);
    corner = random_vertex(draw, w);
  }
  if (corners[0].w <= 0 && corners[1].w <= 0 && corners[2].w <= 0) {
    corners[0].w = draw.uniform(0.125F, 2);
  }
  return corners;
}

/// Returns two vertices and the negative of a point between them, so that their plane contains the
/// eye, x = y = w = 0, up to rounding. The third vertex is then moved by at most one float or
/// clearly off the plane.
std::array<cases::ClipVertex, 3> about_the_eye(Draw& draw) {
  const float first_w = draw.uniform(0.125F, 2);
  const float second_w = draw.uniform(-1, 2);
  const cases::ClipVertex a = random_vertex(draw, first_w);
  const cases::ClipVertex b = random_vertex(draw, second_w);
  const float s = draw.pick(std::array{0.25F, 0.5F, 1.0F, 0.3F});
  const float t = draw.pick(std::array{0.25F, 0.5F, 1.0F, 0.7F});
  const auto opposite = [s, t](float of_a, float of_b) {
    return to_float(-(double{s} * double{of_a} + double{t} * double{of_b}));
  };
  cases::ClipVertex c{opposite(a.x, b.x), opposite(a.y, b.y), 0, opposite(a.w, b.w)};
  switch (draw.between(0, 3)) {
    case 0:
      c.x = nudged(draw, c.x);
      break;
    case 1:
      c.w = nudged(draw, c.w);
      break;
    case 2:
      c.y += draw.uniform(-0.5F, 0.5F);
      break;
    default:  // a large step off the plane: the triangle fills a wedge of the screen
      c.x += draw.uniform(-1, 1);
      c.w += draw.uniform(-1, 1);
  }
  return {a, b, c};
}

/// Returns two vertices in front of the eye, and one whose weight is zero or tiny, of either sign.
std::array<cases::ClipVertex, 3> one_at_zero(Draw& draw) {
  const float first_w = draw.uniform(0.125F, 2);
  const float second_w = draw.uniform(0.125F, 2);
  const float third_w = weight_about_zero(draw);
  const cases::ClipVertex a = random_vertex(draw, first_w);
  const cases::ClipVertex b = random_vertex(draw, second_w);
  const cases::ClipVertex c = random_vertex(draw, third_w);
  return {a, b, c};
}

/// Sets z of the three corners: on a plane z = k w, which no depth plane cuts, or anywhere.
void set_depths(Draw& draw, const cases::Case& c, std::array<cases::ClipVertex, 3>& corners) {
  const bool is_on_plane = !draw.one_in(3);
  const float k = draw.uniform(near_depth(c) * 0.75F, 0.75F);
  for (cases::ClipVertex& corner : corners) {
    corner.z = is_on_plane ? to_float(double{k} * double{corner.w}) : draw.uniform(-1, 1);
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 40;  // many of these triangles fill the framebuffer
  cases::Case c = random_state(draw, request);
  const int triangles = draw.between(1, 1 + draw.size() / 50);
  for (int i = 0; i < triangles; ++i) {
    std::array<cases::ClipVertex, 3> corners;
    switch (draw.between(0, 3)) {
      case 0:
        corners = about_the_eye(draw);
        break;
      case 1:
        corners = one_at_zero(draw);
        break;
      default:
        corners = scattered(draw);
    }
    set_depths(draw, c, corners);
    add_triangle(c, corners[0], corners[1], corners[2]);
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"through-eye", "triangles that reach behind the eye or pass close by it, some w <= 0", &make});

}  // namespace
}  // namespace rastercheck::properties::through_eye_generator
