// near-misses: triangles as in the generator hairline, but in larger frames: needles with a sample
// inside, edges through samples or a float beside them, with coefficients that no double holds, and
// triangles one float off a plane through the eye. The triangles are large enough for a
// rasterizer's fast path, which must notice that it does not apply.

#include <array>
#include <cstddef>
#include <utility>

#include "properties/generator.h"
#include "properties/generators/internal/close_triangles.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::near_misses_generator {
namespace {

/// Moves the viewport by less than a pixel, so that its middle lies on a sample, where clip x and y
/// are 0.
void centre_on_sample(Draw& draw, cases::Case& c) {
  const WindowPoint place = sample_in_pixel(draw, c, visible_middle(c));
  c.viewport.x = static_cast<float>(place.u - double{c.viewport.width} / 2);
  c.viewport.y = static_cast<float>(place.v - double{c.viewport.height} / 2);
}

/// Adds a triangle with an edge along the middle of the viewport, but off by less than a double can
/// resolve: only exact arithmetic tells on which side the samples are. The edge's ends have
/// different numbers, so that no special case applies.
void add_middle_edge(Draw& draw, cases::Case& c) {
  const bool is_upright = draw.one_in(2);
  const auto corner = [&](float aside, float along, float w) {
    const float depth = near_depth(c) < 0 ? 0.0F : 0.5F;
    return is_upright ? cases::ClipVertex{aside, along, depth * w, w}
                      : cases::ClipVertex{along, aside, depth * w, w};
  };
  const float first = draw.spread(-70, -52);
  const float last = draw.spread(-70, -52);
  const float from = draw.uniform(-2, -0.25F);
  const float to = draw.uniform(0.25F, 2);
  const float first_w = draw.uniform(0.5F, 2);
  const float last_w = draw.uniform(0.5F, 2);
  const float third_w = draw.uniform(0.5F, 2);
  const float away = draw.uniform(0.25F, 1);
  const float along = draw.uniform(-1, 1);
  const bool is_below = draw.one_in(2);
  Corners corners{corner(first, from, first_w), corner(last, to, last_w),
                  corner(is_below ? -away : away, along, third_w)};
  if (draw.one_in(2)) std::swap(corners[0], corners[1]);
  add_with_distances(draw, c, corners, {1, 1, 1});
}

/// Adds a triangle with corners a, b and −m a − n b, which lie in a plane through the eye, except
/// that one 0 is replaced by a number so small that only its sign matters. The sign decides the
/// triangle's orientation, which half of the screen the triangle covers, and whether it is culled.
void add_turning(Draw& draw, cases::Case& c) {
  constexpr int kMost = 1 << 20;
  const int m = draw.between(1, 3);
  const int n = draw.between(1, 3);
  const int common = draw.between(-kMost / 8, kMost / 8);
  const int a_y = draw.between(-kMost / 2, kMost / 2);
  const int b_y = draw.between(-kMost / 2, kMost / 2);
  const int a_w = draw.between(kMost / 2, kMost);
  const int b_w = draw.between(kMost / 2, kMost);
  const float rest = draw.spread(-58, -34);
  const auto corner = [](float x, int y, int w) {
    return cases::ClipVertex{x, static_cast<float>(y), 0, static_cast<float>(w)};
  };
  Corners corners{corner(static_cast<float>(n * common), a_y, a_w),
                  corner(static_cast<float>(-m * common), b_y, b_w),
                  corner(rest, -m * a_y - n * b_y, -m * a_w - n * b_w)};
  if (draw.one_in(2)) {
    for (cases::ClipVertex& p : corners) std::swap(p.x, p.y);
  }
  set_exact_depths(draw, corners);
  add_with_distances(draw, c, corners, {1, 1, 1});
}

/// Sets a smooth attribute, a noperspective one, or both, with different values, so that an error
/// in a weight shows. One attribute of a kind is enough, since a rasterizer computes all attributes
/// of a kind in the same way.
void set_attributes(Draw& draw, cases::Case& c) {
  using cases::Interpolation;
  const int kind = draw.pick(std::array{0, 1, 2, 2, 2, 2});
  c.attributes.clear();
  if (kind <= 1) c.attributes.push_back({"a0", Interpolation::smooth, cases::Location::sample});
  if (kind >= 1) {
    c.attributes.push_back({"a1", Interpolation::noperspective, cases::Location::sample});
  }
  for (std::size_t i = 0; i < c.positions.size() * c.attributes.size(); ++i) {
    const float value = draw.uniform(-1, 1);
    c.attribute_values.push_back(value);
  }
}

/// Adds needles after a few triangles that fill up to half of the screen each: what is drawn last
/// stays visible in a frame.
void add_mixed(Draw& draw, cases::Case& c) {
  const int large = draw.between(1, 3);
  for (int i = 0; i < large; ++i) {
    if (draw.one_in(3)) {
      add_close_edge(draw, c);
    } else {
      add_middle_edge(draw, c);
    }
  }
  // Thick enough for a double to tell that the sample is inside, but not how far inside.
  constexpr Exponents kThickness{-42, -20};
  const int needles = draw.between(12, 18 + draw.size() / 20);
  for (int i = 0; i < needles; ++i) add_needle(draw, c, kThickness);
}

void add_edges_on(Draw& draw, cases::Case& c) {
  const int shapes = draw.between(12, 16);
  for (int i = 0; i < shapes; ++i) {
    if (draw.one_in(4)) {
      add_edge_on(draw, c);
    } else {
      add_turning(draw, c);
    }
  }
}

cases::Case make(Draw& draw) {
  const bool is_edge_on = draw.one_in(3);
  StateRequest request;
  request.least_side = is_edge_on ? 8 : 12;
  request.most_side = is_edge_on ? 12 : 24;
  request.is_on_grid = true;
  request.has_clip_distances = false;
  cases::Case c = random_state(draw, request);
  if (draw.one_in(10)) c.clip_distance_count = 1;
  centre_on_sample(draw, c);
  if (is_edge_on && !draw.one_in(8)) {  // culling depends on the orientation
    c.cull = draw.pick(std::array{cases::Cull::back, cases::Cull::front});
    c.coverage.reset();
    c.basis = cases::default_basis(c.rules);
  }
  if (is_edge_on) {
    add_edges_on(draw, c);
  } else {
    add_mixed(draw, c);
  }
  if (draw.one_in(6)) {
    add_attribute_values(draw, c);
  } else {
    set_attributes(draw, c);
  }
  return c;
}

const GeneratorRegistration kRegistration(
    {"near-misses", "needles, edges next to samples, planes next to the eye, in larger frames",
     &make});

}  // namespace
}  // namespace rastercheck::properties::near_misses_generator
