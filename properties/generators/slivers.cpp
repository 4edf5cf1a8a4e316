// slivers: triangles whose corners are close to one line. The weights of a sample are quotients of
// small differences there, and an attribute may run through its whole range within a fraction of a
// pixel.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "properties/generator.h"
#include "properties/internal/random_state.h"
#include "properties/internal/window_position.h"

namespace rastercheck::properties {
namespace {

/// 2^-k.
double fraction(int k) { return 1.0 / static_cast<double>(std::uint64_t{1} << k); }

/// Where a sliver begins and ends: across the screen, between two samples, or a few pixels long.
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
    case 2: {  // along a row or a column of samples, beyond both sides
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

  // The third corner: some way along, and some way off the line, from a pixel's width down to what
  // rounding leaves.
  const double place = draw.pick(std::array{0.0, 0.25, 0.5, 1.0, 2.0});
  const double t = place + double{draw.unit()} / 4;
  const double thickness = draw.one_in(5) ? 0.0 : fraction(draw.between(0, 2 + draw.size() / 4));
  // The larger component as the length: exact up to a factor of √2, without a square root.
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

cases::Case make(Draw& draw) {
  StateRequest request;
  request.least_side = 24;
  cases::Case c = random_state(draw, request);
  const int triangles = draw.between(6, 10 + draw.size() / 8);
  for (int i = 0; i < triangles; ++i) add_sliver(draw, c);
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"slivers", "triangles whose corners are close to one line, long and short", &make});

}  // namespace
}  // namespace rastercheck::properties
