// tiny: triangles smaller than a pixel, the subpixel grid or a float's breadth, as in distant
// meshes. Most triangles draw nothing, but a mesh of them must draw each sample once.

#include <array>
#include <cstdint>

#include "properties/generator.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::tiny_generator {
namespace {

/// Adds a triangle whose corners lie within 4 · 2^-k pixels of a sample along each axis, for a
/// random k. About a quarter of these triangles contain the sample.
void add_speck(Draw& draw, cases::Case& c) {
  const WindowPoint sample = visible_sample(draw, c);
  const double extent = 4 * power_of_two(-draw.between(0, 4 + draw.size() / 6));
  const float depth = random_depth(draw, c);
  std::array<cases::ClipVertex, 3> corners;
  for (cases::ClipVertex& corner : corners) {
    const double du = double{draw.uniform(-1, 1)} * extent;
    const double dv = double{draw.uniform(-1, 1)} * extent;
    const float w = draw.one_in(2) ? 1.0F : draw.uniform(0.25F, 4);
    corner = at_window(c, {sample.u + du, sample.v + dv}, depth, w);
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

/// Adds a triangle with one corner exactly on a sample and the other two up to a pixel away in one
/// of the eight octants; distinguishes tie rules.
void add_octant(Draw& draw, cases::Case& c) {
  const WindowPoint sample = visible_sample(draw, c);
  const double step = draw.pick(std::array{0x1p-8, 0x3p-8, 0x1p-4, 1.0});
  const double side_u = draw.one_in(2) ? step : -step;
  const double side_v = draw.one_in(2) ? step : -step;
  const bool is_upright = draw.one_in(2);
  const WindowPoint diagonal{sample.u + side_u, sample.v + side_v};
  const WindowPoint straight = is_upright ? WindowPoint{sample.u, sample.v + side_v}
                                          : WindowPoint{sample.u + side_u, sample.v};
  const float depth = random_depth(draw, c);
  const cases::ClipVertex first = at_window(c, sample, depth, 1);
  const cases::ClipVertex second = at_window(c, diagonal, depth, 1);
  const cases::ClipVertex third = at_window(c, straight, depth, 1);
  add_triangle(c, first, second, third);
}

/// Adds a triangle with corners near the viewport's middle, where clip x and y are 0. The corners
/// are as little as a subnormal number apart: no subpixel grid, and often no float, distinguishes
/// their window positions.
void add_about_the_middle(Draw& draw, cases::Case& c) {
  const int exponent = draw.pick(std::array{-149, -140, -126, -100, -60, -24, -6, -3});
  const float w = draw.one_in(2) ? 1.0F : draw.uniform(0.25F, 4);
  const float depth = random_depth(draw, c);
  std::array<cases::ClipVertex, 3> corners;
  for (cases::ClipVertex& corner : corners) {
    const float x = draw.spread(exponent, exponent + 2);
    const float y = draw.spread(exponent, exponent + 2);
    corner = {x, y, to_float(double{depth} * double{w}), w};
  }
  // Puts the first corner opposite the other two, so that more triangles contain the middle.
  corners[0].x = -corners[1].x;
  corners[0].y = -corners[2].y;
  add_triangle(c, corners[0], corners[1], corners[2]);
}

/// Adds a fan of small triangles around a hub on a sample, all within a few pixels.
void add_fan(Draw& draw, cases::Case& c) {
  const WindowPoint hub = visible_sample(draw, c);
  const double radius = 4 * power_of_two(-draw.between(0, 10));
  const float depth = random_depth(draw, c);
  const std::uint32_t centre = add_vertex(c, at_window(c, hub, depth, 1));
  // A square's corners and the middles of its sides.
  const std::array<WindowPoint, 8> around{WindowPoint{1, 0}, {1, 1},   {0, 1},  {-1, 1},
                                          {-1, 0},           {-1, -1}, {0, -1}, {1, -1}};
  for (const WindowPoint& p : around) {
    add_vertex(c, at_window(c, {hub.u + radius * p.u, hub.v + radius * p.v}, depth, 1));
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    c.triangles.push_back({centre, centre + 1 + i, centre + 1 + (i + 1) % 8});
  }
}

/// Multiplies all positions by 2^-k, which gives the same picture from numbers close to the
/// smallest floats.
void scale_down(Draw& draw, cases::Case& c) {
  const float factor = draw.pick(std::array{0x1p-30F, 0x1p-100F, 0x1p-120F, 0x1p-130F});
  for (cases::ClipVertex& p : c.positions) {
    p = {p.x * factor, p.y * factor, p.z * factor, p.w * factor};
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 24;  // few pixels, so that most samples are near a triangle
  cases::Case c = random_state(draw, request);
  // A framebuffer with odd sides has a pixel centre in its middle.
  if (draw.one_in(2)) {
    c.viewport = {0, 0, 0, 0, c.viewport.min_depth, c.viewport.max_depth};
    c.framebuffer.width |= 1;
    c.framebuffer.height |= 1;
    c.viewport.width = static_cast<float>(c.framebuffer.width);
    c.viewport.height = static_cast<float>(c.framebuffer.height);
  }
  const int shapes = draw.between(6, 12 + draw.size() / 8);
  for (int i = 0; i < shapes; ++i) {
    switch (draw.between(0, 5)) {
      case 0:
        add_octant(draw, c);
        break;
      case 1:
        add_about_the_middle(draw, c);
        break;
      case 2:
        add_fan(draw, c);
        break;
      default:
        add_speck(draw, c);
    }
  }
  if (draw.one_in(6)) scale_down(draw, c);
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"tiny", "triangles from a few pixels down to the smallest floats", &make});

}  // namespace
}  // namespace rastercheck::properties::tiny_generator
