#include "cases/internal/camera_frame.h"

// Uses only +, −, ×, ÷ and sqrt, which IEEE 754 rounds correctly, so the same mesh gives the same
// camera, bit for bit, on every machine.

#include <algorithm>
#include <cmath>

namespace rastercheck::cases {
namespace {

using Vector3 = std::array<double, 3>;

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 normalized(const Vector3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

Matrix4 to_float(const std::array<double, 16>& values) {
  Matrix4 matrix{};
  std::transform(values.begin(), values.end(), matrix.begin(),
                 [](double value) { return static_cast<float>(value); });
  return matrix;
}

}  // namespace

Camera frame(const Bounds& bounds, Rules rules, double width_over_height) {
  Vector3 center{};
  Vector3 half{};
  for (std::size_t i = 0; i < 3; ++i) {
    center[i] = (bounds.lo[i] + bounds.hi[i]) / 2;
    half[i] = (bounds.hi[i] - bounds.lo[i]) / 2;
  }
  // 5% to spare on all sides, so that rounding the matrices to float32 clips nothing. A single
  // point has no size to frame; any positive radius shows it.
  const double radius = std::max(1.05 * std::sqrt(dot(half, half)), 0x1p-64);

  // The view axes, in object space: the camera looks along −back.
  const Vector3 back = normalized({0.25, 0.25, 1});
  const Vector3 right = normalized(cross({0, 1, 0}, back));
  const Vector3 up = cross(back, right);

  // A sphere touches the sides of a view cone of slope s at distance radius · sqrt(1 + s²) / s.
  constexpr double kSlope = 0.5;
  const double slope_x = kSlope * std::max(width_over_height, 1.0);
  const double slope_y = kSlope * std::max(1 / width_over_height, 1.0);
  const double distance = radius * std::sqrt(1 + kSlope * kSlope) / kSlope;
  const double near = distance - radius;
  const double far = distance + radius;

  Camera camera;
  camera.view = to_float({right[0], right[1], right[2], -dot(right, center),         //
                          up[0], up[1], up[2], -dot(up, center),                     //
                          back[0], back[1], back[2], -dot(back, center) - distance,  //
                          0, 0, 0, 1});
  // w = −z_view; z/w runs from −1 (OpenGL) or 0 at `near` to 1 at `far`. Vulkan's NDC y points
  // down.
  const double nearest_ndc = rules == Rules::opengl ? -1 : 0;
  const double scale = (nearest_ndc * near - far) / (far - near);
  const double offset = (nearest_ndc - 1) * near * far / (far - near);
  const double flip = rules == Rules::vulkan ? -1 : 1;
  camera.projection = to_float({1 / slope_x, 0, 0, 0,     //
                                0, flip / slope_y, 0, 0,  //
                                0, 0, scale, offset,      //
                                0, 0, -1, 0});
  return camera;
}

}  // namespace rastercheck::cases
