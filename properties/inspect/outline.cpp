// If a triangle has a vertex behind the eye, its outline is the guard band clipped by the
// triangle's three lines e_i >= 0, which come from its exact q-matrix. Clipping the triangle's
// edges at the guard band in homogeneous coordinates would fail in doubles if the eye lies almost
// in the triangle's plane. The two points where edges pass w = 0 are then seen in opposite
// directions, and rounding loses the side on which the rest of the triangle lies.

#include "properties/inspect/outline.h"

#include <algorithm>
#include <array>
#include <optional>

namespace rastercheck::properties {
namespace {

using Polygon = std::vector<records::WindowPoint>;

struct Guard {
  records::WindowPoint lo;
  records::WindowPoint hi;
};

Guard guard_of(const cases::Case& c) {
  const double width = c.framebuffer.width;
  const double height = c.framebuffer.height;
  return {{-width, -height}, {2 * width, 2 * height}};
}

/// Returns all three vertices if they are in front of the eye and within the guard band.
std::optional<Polygon> whole(const cases::Case& c, const cases::Triangle& triangle,
                             const Guard& guard) {
  const cases::Viewport& v = c.viewport;
  const double up = c.rules == cases::Rules::d3d ? -1 : 1;
  Polygon corners;
  for (const std::uint32_t vertex : triangle) {
    const cases::ClipVertex& p = c.positions[vertex];
    if (!(p.w > 0)) return std::nullopt;
    const double w = p.w;
    const records::WindowPoint at{(p.x / w + 1) / 2 * v.width + v.x,
                                  (up * p.y / w + 1) / 2 * v.height + v.y};
    const bool is_within =
        at.x >= guard.lo.x && at.x <= guard.hi.x && at.y >= guard.lo.y && at.y <= guard.hi.y;
    if (!is_within) return std::nullopt;
    corners.push_back(at);
  }
  return corners;
}

/// Coefficients a, b, c of a x + b y + c.
using Line = std::array<double, 3>;

/// Returns the part of a polygon on the line's positive side, borders included (Sutherland &
/// Hodgman).
Polygon clipped(const Polygon& polygon, const Line& line) {
  const auto at = [&line](const records::WindowPoint& p) {
    return line[0] * p.x + line[1] * p.y + line[2];
  };
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const records::WindowPoint& from = polygon[i];
    const records::WindowPoint& to = polygon[(i + 1) % polygon.size()];
    const double a = at(from);
    const double b = at(to);
    if (a >= 0) inside.push_back(from);
    const bool is_between = (a > 0 && b < 0) || (a < 0 && b > 0);
    if (!is_between) continue;
    const double t = a / (a - b);
    inside.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
  }
  return inside;
}

}  // namespace

std::vector<records::WindowPoint> outline_of(const oracle::SceneTruth& scene,
                                             std::size_t triangle) {
  const cases::Case& c = scene.source();
  const Guard guard = guard_of(c);
  if (auto corners = whole(c, c.triangles[triangle], guard)) return *std::move(corners);
  const std::optional<oracle::QMatrix> q = oracle::TriangleTruth(scene, triangle).q_matrix();
  if (!q) return {};
  // Where all e_i >= 0, their sum 1/w is >= 0, too, so w needs no clipping of its own.
  Polygon polygon{guard.lo, {guard.hi.x, guard.lo.y}, guard.hi, {guard.lo.x, guard.hi.y}};
  for (const auto& [a, b, e] : *q) {
    polygon = clipped(polygon, {a.nearest_double(), b.nearest_double(), e.nearest_double()});
  }
  return polygon;
}

}  // namespace rastercheck::properties
