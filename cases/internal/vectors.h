#pragma once

// Vectors of three doubles, and the axes of a view. Only +, −, ×, ÷ and sqrt occur, which IEEE 754
// rounds correctly, so the results are the same bits on every machine.

#include <array>
#include <optional>

namespace rastercheck::cases {

using Vector3 = std::array<double, 3>;

double dot(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
Vector3 minus(const Vector3& a, const Vector3& b);
/// a · scale + b
Vector3 scaled_sum(const Vector3& a, double scale, const Vector3& b);
/// The vector divided by its length, which must not be 0.
Vector3 normalized(const Vector3& a);

/// The axes of a camera that looks along −back: unit vectors at right angles, right-handed.
struct ViewAxes {
  Vector3 right{};
  Vector3 up{};
  Vector3 back{};
};

/// Returns the axes of a camera that looks along −back and sees `up` pointing straight up. Neither
/// vector need be a unit vector. Empty if one is 0 or not finite, or if both are parallel as far as
/// float32 can tell.
std::optional<ViewAxes> view_axes(const Vector3& back, const Vector3& up);

}  // namespace rastercheck::cases
