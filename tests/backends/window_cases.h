#pragma once

// Cases of 16 × 16 pixels for tests of drivers, built from vertices at window positions.

#include <cstdint>
#include <vector>

#include "cases/case.h"

namespace rastercheck::backends {

inline constexpr float kSide = 16;

/// A vertex at a window position, in pixels.
inline cases::ClipVertex at(float u, float v, float z = 0, float w = 1) {
  return {(u / (kSide / 2) - 1) * w, (v / (kSide / 2) - 1) * w, z * w, w};
}

/// A case of 16 × 16 pixels without triangles.
inline cases::Case empty_case(cases::Rules rules = cases::Rules::opengl) {
  cases::Case c;
  c.rules = rules;
  c.framebuffer = {16, 16, 1};
  c.viewport = {0, 0, kSide, kSide, 0, 1};
  return c;
}

/// Adds a triangle. `values` are its attributes, [vertex][attribute].
inline void add(cases::Case& c, const std::vector<cases::ClipVertex>& corners,
                const std::vector<float>& values = {}) {
  const auto first = static_cast<std::uint32_t>(c.positions.size());
  c.positions.insert(c.positions.end(), corners.begin(), corners.end());
  c.attribute_values.insert(c.attribute_values.end(), values.begin(), values.end());
  c.triangles.push_back({first, first + 1, first + 2});
}

/// A triangle that covers the whole window and more.
inline std::vector<cases::ClipVertex> everything(float z = 0) {
  return {at(0, 0, z), at(2 * kSide, 0, z), at(0, 2 * kSide, z)};
}

/// A triangle that covers everything to the left of a vertical line. It is counter-clockwise if
/// window y points up.
inline std::vector<cases::ClipVertex> left_of(float u, float z = 0) {
  return {at(u, -24, z), at(u, 40, z), at(-100, 8, z)};
}

}  // namespace rastercheck::backends
