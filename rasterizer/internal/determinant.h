#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The determinant whose sign decides which way a triangle faces and whether it covers anything at
// all.

#include <glm/vec4.hpp>

namespace rastercheck::rasterizer {

/// Returns the sign, −1, 0 or 1, of the determinant of the columns (x, y, w) of three clip
/// positions. Exact for all finite floats, whatever the signs of w. Ignores z.
int determinant_sign(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c);

/// Returns the same determinant with a relative error below 2^-52; 0 only if the determinant is
/// exactly 0.
double determinant(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c);

}  // namespace rastercheck::rasterizer
