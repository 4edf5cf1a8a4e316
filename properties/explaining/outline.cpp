// Clipping in homogeneous coordinates, one half-space after the other (Sutherland & Hodgman): a
// vertex behind the eye has no window position, but where its edges cross a plane has one.

#include "properties/explaining/outline.h"

#include <array>
#include <cmath>

namespace rastercheck::properties {
namespace {

/// Window position times w, and w.
using Corner = std::array<double, 3>;
using Polygon = std::vector<Corner>;

Corner window_corner(const cases::Case& c, const cases::ClipVertex& p) {
  const cases::Viewport& v = c.viewport;
  const double y = c.rules == cases::Rules::d3d ? -double{p.y} : double{p.y};
  return {(double{p.x} + p.w) * v.width / 2 + double{p.w} * v.x,
          (y + p.w) * v.height / 2 + double{p.w} * v.y, p.w};
}

double side_of(const Corner& plane, const Corner& corner) {
  return plane[0] * corner[0] + plane[1] * corner[1] + plane[2] * corner[2];
}

/// The part where plane · (x, y, w) >= 0.
Polygon clipped(const Polygon& polygon, const Corner& plane) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& from = polygon[i];
    const Corner& to = polygon[(i + 1) % polygon.size()];
    const double a = side_of(plane, from);
    const double b = side_of(plane, to);
    if (a >= 0) inside.push_back(from);
    if ((a >= 0) == (b >= 0)) continue;
    const double t = a / (a - b);
    Corner between{};
    for (std::size_t k = 0; k < 3; ++k) between[k] = from[k] + t * (to[k] - from[k]);
    inside.push_back(between);
  }
  return inside;
}

}  // namespace

std::vector<records::WindowPoint> outline_of(const cases::Case& c,
                                             const cases::Triangle& triangle) {
  Polygon polygon;
  for (const std::uint32_t vertex : triangle) {
    polygon.push_back(window_corner(c, c.positions[vertex]));
  }
  const double width = c.framebuffer.width;
  const double height = c.framebuffer.height;
  const std::array<Corner, 5> planes{{{0, 0, 1},
                                      {1, 0, width},       // x >= -width
                                      {-1, 0, 2 * width},  // x <= 2 width
                                      {0, 1, height},      // y alike
                                      {0, -1, 2 * height}}};
  for (const Corner& plane : planes) polygon = clipped(polygon, plane);
  std::vector<records::WindowPoint> outline;
  for (const auto& [x, y, w] : polygon) {
    // Only the eye's own plane through the eye leaves w = 0.
    const records::WindowPoint point{x / w, y / w};
    if (std::isfinite(point.x) && std::isfinite(point.y)) outline.push_back(point);
  }
  return outline;
}

}  // namespace rastercheck::properties
