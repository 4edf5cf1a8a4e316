#include "backends/internal/view_clipping.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace rastercheck::backends {
namespace {

/// A function of a vertex that is 0 or positive on the side of a clip plane that is kept.
using Plane = double (*)(const Vertex& v, std::size_t index);

Vertex mean(const Vertex& a, const Vertex& b, double t) {
  const auto between = [t](double from, double to) { return from + t * (to - from); };
  Vertex c{between(a.x, b.x), between(a.y, b.y), between(a.z, b.z), between(a.w, b.w), {}};
  for (std::size_t i = 0; i < c.distances.size(); ++i) {
    c.distances[i] = between(a.distances[i], b.distances[i]);
  }
  return c;
}

/// Clips the part of the triangle that is left by another plane.
void clip_by(Clipped& clipped, const std::array<Vertex, 3>& triangle, Plane plane,
             std::size_t index, bool is_side) {
  if (clipped.is_empty) return;
  std::vector<Vertex> left;
  const std::vector<Vertex>& all = clipped.polygon;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vertex& a = all[i];
    const Vertex& b = all[(i + 1) % all.size()];
    const double at_a = plane(a, index);
    const double at_b = plane(b, index);
    if (at_a >= 0) left.push_back(a);
    if ((at_a < 0) != (at_b < 0)) left.push_back(mean(a, b, at_a / (at_a - at_b)));
  }
  // A plane counts even if others leave nothing for it to cut: a driver may cut by it first, and
  // its new vertices are then off when the others cut.
  const bool cuts = std::any_of(triangle.begin(), triangle.end(),
                                [&](const Vertex& v) { return plane(v, index) < 0; });
  clipped.planes += cuts ? 1 : 0;
  clipped.is_cut_at_the_sides = clipped.is_cut_at_the_sides || (cuts && is_side);
  clipped.is_empty = left.empty();
  // A driver may still draw something after a second plane, because new vertices are slightly off.
  if (!clipped.is_empty || clipped.planes == 1) clipped.polygon = std::move(left);
}

}  // namespace

Clipped clipped_to_view(const cases::Case& c, const std::array<Vertex, 3>& triangle) {
  Clipped clipped{{triangle.begin(), triangle.end()}};
  constexpr std::array<Plane, 4> kSides{[](const Vertex& v, std::size_t) { return v.w + v.x; },
                                        [](const Vertex& v, std::size_t) { return v.w - v.x; },
                                        [](const Vertex& v, std::size_t) { return v.w + v.y; },
                                        [](const Vertex& v, std::size_t) { return v.w - v.y; }};
  if (!c.depth_clamp) {
    const bool from_minus_one = c.rules == cases::Rules::opengl;
    const Plane near = [](const Vertex& v, std::size_t) { return v.z; };
    const Plane near_of_opengl = [](const Vertex& v, std::size_t) { return v.w + v.z; };
    clip_by(clipped, triangle, from_minus_one ? near_of_opengl : near, 0, false);
    clip_by(
        clipped, triangle, [](const Vertex& v, std::size_t) { return v.w - v.z; }, 0, false);
  }
  for (std::size_t i = 0; i < c.clip_distance_count; ++i) {
    clip_by(
        clipped, triangle, [](const Vertex& v, std::size_t index) { return v.distances[index]; }, i,
        false);
  }
  for (const Plane side : kSides) clip_by(clipped, triangle, side, 0, true);
  return clipped;
}

}  // namespace rastercheck::backends
