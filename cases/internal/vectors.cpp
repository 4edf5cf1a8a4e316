#include "cases/internal/vectors.h"

#include <algorithm>
#include <cmath>

namespace rastercheck::cases {
namespace {

/// The vector with a length of 1; empty if it has no direction.
std::optional<Vector3> direction_of(const Vector3& a) {
  if (!std::all_of(a.begin(), a.end(), [](double x) { return std::isfinite(x); })) {
    return std::nullopt;
  }
  // Dividing by the largest component first keeps the squares from overflowing and vanishing.
  const double largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  if (largest == 0) return std::nullopt;
  return normalized({a[0] / largest, a[1] / largest, a[2] / largest});
}

}  // namespace

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector3 scaled_sum(const Vector3& a, double scale, const Vector3& b) {
  return {a[0] * scale + b[0], a[1] * scale + b[1], a[2] * scale + b[2]};
}

Vector3 normalized(const Vector3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

std::optional<ViewAxes> view_axes(const Vector3& back, const Vector3& up) {
  const std::optional<Vector3> to_eye = direction_of(back);
  const std::optional<Vector3> upward = direction_of(up);
  if (!to_eye || !upward) return std::nullopt;
  const Vector3 across = cross(*upward, *to_eye);
  // The length is the sine of the angle between the two. Unit vectors whose angle is below 2^-24,
  // half of float32's distance from 1 to the next number, cannot be told apart by a float32 matrix.
  constexpr double kParallel = 0x1p-24;
  if (dot(across, across) < kParallel * kParallel) return std::nullopt;
  const Vector3 right = normalized(across);
  return ViewAxes{right, cross(*to_eye, right), *to_eye};
}

}  // namespace rastercheck::cases
