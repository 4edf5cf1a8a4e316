#include "backends/internal/affine_condition.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rastercheck::backends {

double condition_of(const cases::Viewport& viewport, const std::array<Vertex, 3>& triangle) {
  const auto farthest = [](float from, float extent) {
    return std::max(std::fabs(double{from}), std::fabs(double{from} + double{extent}));
  };
  const double u = farthest(viewport.x, viewport.width);
  const double v = farthest(viewport.y, viewport.height);
  std::array<std::array<double, 3>, 3> size{};
  std::array<std::array<double, 3>, 3> column{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex& p = triangle[i];
    const double half_w = double{viewport.width} / 2;
    const double half_h = double{viewport.height} / 2;
    column[i] = {p.x * half_w + p.w * (double{viewport.x} + half_w),
                 p.y * half_h + p.w * (double{viewport.y} + half_h), p.w};
    size[i] = {std::fabs(p.x * half_w) +
                   std::fabs(p.w) * (std::fabs(double{viewport.x}) + std::fabs(half_w)),
               std::fabs(p.y * half_h) +
                   std::fabs(p.w) * (std::fabs(double{viewport.y}) + std::fabs(half_h)),
               std::fabs(p.w)};
  }
  double determinant = 0;
  double sizes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = column[(i + 1) % 3];
    const auto& b = column[(i + 2) % 3];
    determinant += column[i][2] * (a[0] * b[1] - a[1] * b[0]);
    const auto& [x_j, y_j, w_j] = size[(i + 1) % 3];
    const auto& [x_k, y_k, w_k] = size[(i + 2) % 3];
    sizes += size[i][2] *
             ((y_j * w_k + y_k * w_j) * u + (x_j * w_k + x_k * w_j) * v + x_j * y_k + x_k * y_j);
  }
  return sizes / std::fabs(determinant);
}

}  // namespace rastercheck::backends
