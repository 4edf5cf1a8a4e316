#include "properties/probing/depth_planes.h"

#include <cmath>
#include <map>
#include <tuple>

namespace rastercheck::properties {

DepthTriangle triangle_in_cell(std::size_t cell, double depth, double along_x, double along_y) {
  constexpr std::size_t kPerRow = 8;
  constexpr double kSide = 8;  // pixels
  const double u = kSide * static_cast<double>(cell % kPerRow);
  const std::size_t row = cell / kPerRow;
  const double v = kSide * static_cast<double>(row);
  return {{{{u, v}, {u + kSide, v}, {u, v + kSide}}},
          {depth, depth + kSide * along_x, depth + kSide * along_y}};
}

cases::Case case_of_planes(const Subject& subject, const std::vector<DepthTriangle>& triangles,
                           const DepthState& state) {
  cases::Case c = subject.base(state.rules);
  c.viewport.min_depth = state.min_depth;
  c.viewport.max_depth = state.max_depth;
  c.depth_clamp = state.depth_clamp;
  c.depth_bias = state.bias;
  c.depth_format = state.format;
  const double low = double{state.min_depth};
  const double size = double{state.max_depth} - low;
  for (const DepthTriangle& triangle : triangles) {
    std::array<cases::ClipVertex, 3> vertices;
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = (triangle.depth[i] - low) / size;
      const double z = c.rules == cases::Rules::opengl ? 2 * share - 1 : share;
      vertices[i] = at_window(c, triangle.at[i], to_float(z), triangle.w[i]);
    }
    add_triangle(c, vertices[0], vertices[1], vertices[2]);
  }
  return c;
}

std::optional<cases::Fragments> draw_planes(Subject& subject,
                                            const std::vector<DepthTriangle>& triangles,
                                            const DepthState& state) {
  return subject.draw(case_of_planes(subject, triangles, state));
}

double depth_of_plane(const DepthTriangle& triangle, const WindowPoint& at) {
  const auto& [a, b, c] = triangle.at;
  const double bx = b.u - a.u;
  const double by = b.v - a.v;
  const double cx = c.u - a.u;
  const double cy = c.v - a.v;
  const double area = bx * cy - by * cx;
  const double of_b = ((at.u - a.u) * cy - (at.v - a.v) * cx) / area;
  const double of_c = (bx * (at.v - a.v) - by * (at.u - a.u)) / area;
  return triangle.depth[0] + of_b * (triangle.depth[1] - triangle.depth[0]) +
         of_c * (triangle.depth[2] - triangle.depth[0]);
}

WindowPoint sample_of(const Subject& subject, const cases::Fragments& drawn, std::size_t fragment) {
  const cases::PixelFraction& at = subject.sample();
  const double parts = at.parts;
  return {drawn.x[fragment] + at.x / parts, drawn.y[fragment] + at.y / parts};
}

std::vector<BiasedFragment> biased_fragments(const Subject& subject,
                                             const cases::Fragments& without,
                                             const cases::Fragments& with) {
  std::map<std::tuple<std::uint32_t, int, int>, double> depths;
  for (std::size_t i = 0; i < without.size(); ++i) {
    depths[{without.triangle[i], without.y[i], without.x[i]}] = double{without.depth[i]};
  }
  std::vector<BiasedFragment> all;
  for (std::size_t i = 0; i < with.size(); ++i) {
    const auto found = depths.find({with.triangle[i], with.y[i], with.x[i]});
    if (found == depths.end() || !std::isfinite(found->second) || !std::isfinite(with.depth[i])) {
      continue;
    }
    all.push_back(
        {with.triangle[i], sample_of(subject, with, i), found->second, double{with.depth[i]}});
  }
  return all;
}

int exponent_of(double z) { return std::ilogb(z); }

}  // namespace rastercheck::properties
