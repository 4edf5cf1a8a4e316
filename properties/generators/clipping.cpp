// clipping: triangles that leave the view volume in every possible way. One, two or three vertices
// far outside in each of the 26 directions of the volume's sides, edges and corners; polygons that
// all six planes cut; fans and quads many times larger than the volume, through its middle and
// close to its planes; clip w of either sign, one float from 0.

#include <algorithm>
#include <array>
#include <cstdint>

#include "properties/generator.h"
#include "properties/random_floats.h"
#include "properties/random_state.h"
#include "properties/window_position.h"

namespace rastercheck::properties::clipping_generator {
namespace {

/// A place in the view volume, which is scaled to [−1, 1]³ under all rules.
struct VolumePoint {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// The clip position at `p` with weight w.
cases::ClipVertex at_volume(const cases::Case& c, const VolumePoint& p, float w) {
  const double near = double{near_depth(c)};
  const double depth = near + (1 - near) * (p.z + 1) / 2;
  return {to_float(p.x * double{w}), to_float(p.y * double{w}), to_float(depth * double{w}), w};
}

VolumePoint scaled_from(const VolumePoint& from, double factor, const VolumePoint& direction) {
  return {from.x + factor * direction.x, from.y + factor * direction.y,
          from.z + factor * direction.z};
}

VolumePoint random_inside(Draw& draw) {
  const double x = double{draw.uniform(-1, 1)};
  const double y = double{draw.uniform(-1, 1)};
  const double z = double{draw.uniform(-1, 1)};
  return {x, y, z};
}

float random_weight(Draw& draw) { return draw.one_in(2) ? 1.0F : draw.uniform(0.1F, 4); }

/// Returns direction number `index` (0…25) of the 26 directions with components −1, 0 and 1.
VolumePoint outside_direction(int index) {
  const int number = index < 13 ? index : index + 1;  // 13 is the middle
  const int x = number % 3 - 1;
  const int y = number / 3 % 3 - 1;
  const int z = number / 9 - 1;
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

/// Adds a triangle with `outside` vertices far outside in one direction and the other vertices
/// inside. With three vertices outside, the triangle lies beside the volume.
void add_outside(Draw& draw, cases::Case& c, int direction, int outside) {
  const double distance = draw.pick(std::array{3e4, 3e4, 3e4, 2.0, 1e5, 1e9});
  std::array<cases::ClipVertex, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    VolumePoint p = random_inside(draw);
    if (static_cast<int>(i) < outside) p = scaled_from(p, distance, outside_direction(direction));
    const float w = random_weight(draw);
    corners[i] = at_volume(c, p, w);
  }
  const int turns = draw.between(0, 2);
  std::rotate(corners.begin(), corners.begin() + turns, corners.end());
  add_triangle(c, corners[0], corners[1], corners[2]);
}

/// Adds a triangle around the volume's middle, up to 10^5 times as large as the volume. The
/// triangle's plane, roughly ±x ± y ± z = 0, meets all six sides of the volume.
void add_hexagon(Draw& draw, cases::Case& c) {
  const double a = double{draw.uniform(0.75F, 1.25F)} * (draw.one_in(2) ? 1 : -1);
  const double b = double{draw.uniform(0.75F, 1.25F)} * (draw.one_in(2) ? 1 : -1);
  const double off = double{draw.uniform(-0.25F, 0.25F)};
  const double size = draw.pick(std::array{4.0, 64.0, 3e4, 1e5});
  const auto place = [&](double x, double y) {
    return VolumePoint{size * x, size * y, -a * size * x - b * size * y + off};
  };
  constexpr std::array<WindowPoint, 3> kAround{{{1, 0.25}, {-0.75, 0.875}, {-0.375, -1}}};
  const bool is_mirrored = draw.one_in(2);
  const float w = random_weight(draw);
  std::array<cases::ClipVertex, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const WindowPoint& p = kAround[i];
    corners[i] = at_volume(c, place(is_mirrored ? -p.u : p.u, p.v), w);
  }
  add_triangle(c, corners[0], corners[1], corners[2]);
}

/// Adds a fan of radius 7·10^4 in a plane through or near the volume's middle, tilted so that its
/// depth leaves the volume too; the hub lies inside or beside the volume.
void add_fan(Draw& draw, cases::Case& c) {
  constexpr double kRadius = 7e4;
  const double tilt_x = double{draw.uniform(-1, 1)};
  const double tilt_y = double{draw.uniform(-1, 1)};
  VolumePoint hub = random_inside(draw);
  if (draw.one_in(4)) hub.x += draw.one_in(2) ? 3 : -3;
  const int per_side = draw.between(2, 4 + draw.size() / 12);
  constexpr std::array<WindowPoint, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const float w = random_weight(draw);
  const std::uint32_t centre = add_vertex(c, at_volume(c, hub, w));
  for (std::size_t side = 0; side < 4; ++side) {
    const WindowPoint& from = kCorners[side];
    const WindowPoint& to = kCorners[(side + 1) % 4];
    for (int i = 0; i < per_side; ++i) {
      const double t = static_cast<double>(i) / per_side;
      const double x = from.u + t * (to.u - from.u);
      const double y = from.v + t * (to.v - from.v);
      const VolumePoint p = scaled_from(hub, kRadius, {x, y, tilt_x * x + tilt_y * y});
      const float weight = draw.one_in(2) ? w : random_weight(draw);
      add_vertex(c, at_volume(c, p, weight));
    }
  }
  const auto rim = static_cast<std::uint32_t>(4 * per_side);
  for (std::uint32_t i = 0; i < rim; ++i) {
    c.triangles.push_back({centre, centre + 1 + i, centre + 1 + (i + 1) % rim});
  }
}

/// Adds a quad of radius 4·10^4, parallel to one of the volume's planes except for a tilt, around
/// the volume's middle or a point 0.99 of the way to the plane.
void add_quad(Draw& draw, cases::Case& c) {
  constexpr double kRadius = 4e4;
  const int axis = draw.between(0, 2);
  const double at = draw.pick(std::array{0.0, 0.99, -0.99});
  const double tilt = draw.one_in(2) ? 0.0 : double{draw.uniform(-1, 1)} * 0x1p-10;
  const double other_tilt = double{draw.uniform(-1, 1)} * (draw.one_in(2) ? 1.0 : 0x1p-15);
  const float w = random_weight(draw);
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  for (std::size_t i = 0; i < 4; ++i) {
    const double s = i == 1 || i == 2 ? kRadius : -kRadius;
    const double t = i >= 2 ? kRadius : -kRadius;
    const double across = at + tilt * s + other_tilt * t;
    const float weight = draw.one_in(2) ? w : random_weight(draw);
    const VolumePoint p = axis == 0   ? VolumePoint{across, s, t}
                          : axis == 1 ? VolumePoint{t, across, s}
                                      : VolumePoint{s, t, across};
    add_vertex(c, at_volume(c, p, weight));
  }
  c.triangles.push_back({first, first + 1, first + 2});
  c.triangles.push_back({first, first + 2, first + 3});
}

/// Adds a triangle with weights of 0 or of the least positive and negative floats, so that the
/// horizon runs through the triangle or through vertices.
void add_about_zero(Draw& draw, cases::Case& c) {
  const bool is_subnormal = draw.one_in(2);
  std::array<cases::ClipVertex, 3> corners;
  for (cases::ClipVertex& p : corners) {
    p.w = float_near(draw, 0.0F, 1);
    if (is_subnormal) {
      p.x = float_near(draw, 0.0F, 3);
      p.y = float_near(draw, 0.0F, 3);
    } else {
      p.x = draw.uniform(-1, 1);
      p.y = draw.uniform(-1, 1);
    }
    p.z = near_depth(c) < 0 ? 0.0F : p.w / 2;
  }
  // Half of these triangles have a vertex in front of the eye; the other half are entirely at
  // infinity.
  if (draw.one_in(2)) corners[2].w = draw.uniform(0.125F, 2);
  add_triangle(c, corners[0], corners[1], corners[2]);
}

cases::Case make(Draw& draw) {
  StateRequest request;
  request.most_side = 32;  // many of these triangles fill the framebuffer
  cases::Case c = random_state(draw, request);
  c.depth_clamp = draw.one_in(16);
  // Three shapes in five come from add_outside(). They take the directions in turn, starting with a
  // random direction.
  int direction = draw.between(0, 25);
  const int shapes = draw.between(2, 5 + draw.size() / 34);
  for (int i = 0; i < shapes; ++i) {
    switch (draw.between(0, 9)) {
      case 0:
        add_hexagon(draw, c);
        break;
      case 1:
        add_fan(draw, c);
        break;
      case 2:
        add_quad(draw, c);
        break;
      case 3:
        add_about_zero(draw, c);
        break;
      default: {
        const int outside = draw.pick(std::array{1, 1, 2, 2, 3});
        add_outside(draw, c, direction, outside);
        direction = (direction + 1) % 26;
      }
    }
  }
  add_attribute_values(draw, c);
  add_clip_distances(draw, c);
  return c;
}

const GeneratorRegistration kRegistration(
    {"clipping", "vertices far outside in all 26 directions, polygons through all six planes",
     &make});

}  // namespace
}  // namespace rastercheck::properties::clipping_generator
