// snap-ties: cases whose result depends on how window positions are rounded to a subpixel grid.
// They have positions exactly between two grid points or a float to either side, corners that
// rounding makes collinear, triangles that rounding flattens or flips, vertices on and around the
// guard band, and meshes and fans whose shared vertices must be rounded alike.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::snap_ties_generator {
namespace {

/// Pixels from the window origin beyond which a vertex may be clipped.
constexpr double kGuardBand = 32768;

/// Grid points per pixel.
double grid_of(const cases::Case& c) { return power_of_two(c.coverage->subpixel_bits); }

/// Rounds a point towards the origin to a grid point; coordinates must be below 2^15.
WindowPoint grid_point(const cases::Case& c, const WindowPoint& p) {
  const double grid = grid_of(c);
  const auto down = [grid](double coordinate) {
    return static_cast<double>(static_cast<std::int64_t>(coordinate * grid)) / grid;
  };
  return {down(p.u), down(p.v)};
}

/// A coordinate's distance from a grid point, in grid units; mostly 1/2, midway to the next grid
/// point.
double random_offset(Draw& draw) {
  return draw.pick(std::array{0.5, 0.5, 0.5, -0.5, 0.0, 0.25, -0.375});
}

/// Returns the clip position at `p`, sometimes moved by a float in x or in y. If not moved, the
/// position is exact if w is a power of two and the numbers have few bits.
cases::ClipVertex placed(Draw& draw, const cases::Case& c, const WindowPoint& p) {
  const float w = draw.pick(std::array{1.0F, 1.0F, 1.0F, 0.5F, 2.0F, 8.0F, 3.0F});
  const float depth = random_depth(draw, c);
  cases::ClipVertex vertex = at_window(c, p, depth, w);
  switch (draw.between(0, 3)) {
    case 0:
      vertex.x = nudged(draw, vertex.x);
      break;
    case 1:
      vertex.y = nudged(draw, vertex.y);
      break;
    default:
      break;
  }
  return vertex;
}

/// Adds a vertex `u` and `v` grid units from a grid point.
std::uint32_t add_offset(Draw& draw, cases::Case& c, const WindowPoint& point, double u, double v) {
  const double grid = grid_of(c);
  return add_vertex(c, placed(draw, c, {point.u + u / grid, point.v + v / grid}));
}

/// Adds a vertex that is often midway between two or four grid points.
std::uint32_t add_tie(Draw& draw, cases::Case& c, const WindowPoint& p) {
  const double u = random_offset(draw);
  const double v = random_offset(draw);
  return add_offset(draw, c, grid_point(c, p), u, v);
}

void add_last_triangle(cases::Case& c) {
  const auto end = static_cast<std::uint32_t>(c.positions.size());
  c.triangles.push_back({end - 3, end - 2, end - 1});
}

/// Adds a triangle of three add_tie() vertices in or near the visible part, some next to samples.
void add_tie_triangle(Draw& draw, cases::Case& c) {
  for (int i = 0; i < 3; ++i) {
    const WindowPoint p = draw.one_in(3) ? visible_sample(draw, c) : point_about(draw, c);
    add_tie(draw, c, p);
  }
  add_last_triangle(c);
}

/// Adds a triangle with corners on one line of grid points, or so close that rounding moves them
/// back to the line. One corner in four is moved by up to a whole grid unit, so that some triangles
/// keep an area.
void add_collinear(Draw& draw, cases::Case& c) {
  const WindowPoint from = grid_point(c, visible_sample(draw, c));
  const int pixels = draw.between(1, 16);
  const auto most = static_cast<int>(grid_of(c)) * pixels;
  const double along_u = draw.between(-most, most);
  const double along_v = draw.between(-most, most);
  const int first = draw.between(-2, 0);
  const int last = draw.between(1, 2);
  for (const int t : {0, first, last}) {
    const bool is_off = draw.one_in(4);
    const double u = is_off ? draw.between(-1, 1) : random_offset(draw);
    const double v = is_off ? draw.between(-1, 1) : random_offset(draw);
    add_offset(draw, c, from, t * along_u + u, t * along_v + v);
  }
  add_last_triangle(c);
}

/// Adds a triangle of about a grid unit at a sample; rounding may flatten or flip the triangle.
void add_speck(Draw& draw, cases::Case& c) {
  const WindowPoint sample = grid_point(c, visible_sample(draw, c));
  const double extent = draw.pick(std::array{1.0, 1.0, 2.0, 4.0});
  for (int i = 0; i < 3; ++i) {
    const double quarters_u = draw.between(-4, 4);
    const double quarters_v = draw.between(-4, 4);
    add_offset(draw, c, sample, extent * quarters_u / 4, extent * quarters_v / 4);
  }
  add_last_triangle(c);
}

/// Adds a long triangle narrower than two grid units, which may reach beyond the screen; rounding
/// may flip or widen the triangle.
void add_turning(Draw& draw, cases::Case& c) {
  const WindowPoint from = grid_point(c, visible_sample(draw, c));
  const double length_u = draw.between(-24, 24);
  const double length_v = draw.between(-24, 24);
  const double grid = grid_of(c);
  for (int i = 0; i < 3; ++i) {
    const double quarters_u = draw.between(-4, 4);
    const double quarters_v = draw.between(-4, 4);
    const double t = i == 0 ? -1 : (i == 1 ? 1 : draw.between(-1, 1));
    add_offset(draw, c, from, t * length_u * grid + quarters_u / 4,
               t * length_v * grid + quarters_v / 4);
  }
  add_last_triangle(c);
}

/// A coordinate on the border of the guard band, or some pixels outside or inside it.
double about_guard_band(Draw& draw) {
  const double beside = draw.pick(std::array{0.0, 0.0, 0.0, 1.0, -1.0, 1024.0, -8192.0, 0x1p20});
  return draw.one_in(2) ? -kGuardBand - beside : kGuardBand + beside;
}

/// Adds a vertex on or near the guard band's border in x, in y or in both; possibly a float to one
/// side.
void add_far(Draw& draw, cases::Case& c) {
  WindowPoint p = point_about(draw, c);
  const int axes = draw.between(1, 3);
  if ((axes & 1) != 0) p.u = about_guard_band(draw);
  if ((axes & 2) != 0) p.v = about_guard_band(draw);
  const float depth = random_depth(draw, c);
  const float w = draw.pick(std::array{1.0F, 1.0F, 0.5F, 2.0F});
  cases::ClipVertex vertex = at_window(c, p, depth, w);
  if (draw.one_in(2)) {
    vertex.x = nudged(draw, vertex.x);
    vertex.y = nudged(draw, vertex.y);
  }
  add_vertex(c, vertex);
}

/// Adds a vertex that may be clipped: at the guard band, beyond a depth plane, or with w <= 0.
void add_clipped(Draw& draw, cases::Case& c) {
  switch (draw.between(0, 5)) {
    case 0:
    case 1:
    case 2:
      add_far(draw, c);
      return;
    case 3: {
      const double beyond = double{draw.unit()};
      const double depth = draw.one_in(2) ? 1 + beyond : double{near_depth(c)} - beyond;
      cases::ClipVertex vertex = placed(draw, c, point_about(draw, c));
      vertex.z = to_float(depth * double{vertex.w});
      add_vertex(c, vertex);
      return;
    }
    default: {
      const float x = draw.uniform(-2, 2);
      const float y = draw.uniform(-2, 2);
      const float z = draw.unit();
      const float w = draw.one_in(2) ? 0.0F : draw.uniform(-1, 0);
      add_vertex(c, {x, y, z, w});
    }
  }
}

void add_clipped_triangle(Draw& draw, cases::Case& c) {
  const int clipped = draw.between(1, 2);
  for (int i = 0; i < 3; ++i) {
    if (i < clipped) {
      add_clipped(draw, c);
    } else {
      add_tie(draw, c, point_about(draw, c));
    }
  }
  add_last_triangle(c);
  cases::Triangle& triangle = c.triangles.back();
  const int turns = draw.between(0, 2);
  std::rotate(triangle.begin(), triangle.begin() + turns, triangle.end());
}

/// The distance between vertices of a strip or a fan, in pixels; possibly far larger than the
/// viewport.
double random_spacing(Draw& draw) {
  const double pixels = draw.pick(std::array{0.125, 1.0, 3.0, 5.0, 9.0, 200.0, 4000.0});
  return pixels * (1 + double{draw.unit()});
}

/// Adds two rows of vertices with a strip between them.
void add_strip(Draw& draw, cases::Case& c) {
  const WindowPoint from = visible_sample(draw, c);
  const double across = random_spacing(draw);
  const double along = random_spacing(draw);
  const bool is_upright = draw.one_in(2);
  const int vertices = draw.between(4, 6 + draw.size() / 20);
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (int i = 0; i < vertices; ++i) {
    const double s = (i - vertices / 2.0) * along / 2;
    const double t = (i % 2 == 0 ? -across : across) / 2;
    add_tie(draw, c, {from.u + (is_upright ? t : s), from.v + (is_upright ? s : t)});
  }
  for (std::uint32_t i = first; i + 2 < first + static_cast<std::uint32_t>(vertices); ++i) {
    const bool is_odd = (i - first) % 2 != 0;
    c.triangles.push_back({is_odd ? i + 1 : i, is_odd ? i : i + 1, i + 2});
  }
}

/// Adds eight triangles around a hub.
void add_fan(Draw& draw, cases::Case& c) {
  constexpr std::array<WindowPoint, 8> kRing{WindowPoint{4, 0},  {3, 3},   {0, 4},  {-3, 3},
                                             WindowPoint{-4, 0}, {-3, -3}, {0, -4}, {3, -3}};
  const WindowPoint hub = visible_sample(draw, c);
  const double radius = random_spacing(draw) / 4;
  const std::uint32_t centre = add_tie(draw, c, hub);
  for (const WindowPoint& p : kRing) {
    add_tie(draw, c, {hub.u + radius * p.u, hub.v + radius * p.v});
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    c.triangles.push_back({centre, centre + 1 + i, centre + 1 + (i + 1) % 8});
  }
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.is_on_grid = true;
  request.most_side = 32;
  cases::Case c = random_state(draw, request);
  const int bits = draw.between(4, cases::kMaxSubpixelBits);
  c.coverage = cases::Snapping{bits, cases::Rounding::nearest_even, 0};
  c.basis = draw.pick(std::array{cases::Basis::ideal, cases::Basis::snapped});
  const int shapes = draw.between(3, 6 + draw.size() / 20);
  for (int i = 0; i < shapes; ++i) {
    switch (draw.between(0, 9)) {
      case 0:
        add_tie_triangle(draw, c);
        break;
      case 1:
      case 2:
        add_collinear(draw, c);
        break;
      case 3:
        add_speck(draw, c);
        break;
      case 4:
      case 9:
        add_turning(draw, c);
        break;
      case 5:
        add_strip(draw, c);
        break;
      case 6:
        add_fan(draw, c);
        break;
      default:
        add_clipped_triangle(draw, c);
    }
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"snap-ties", "window positions midway between points of a subpixel grid, and next to that",
     &make});

}  // namespace
}  // namespace rastercheck::properties::snap_ties_generator
