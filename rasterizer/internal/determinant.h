#pragma once

// The determinant whose sign decides which way a triangle faces and whether it covers anything at
// all.

#include <glm/vec4.hpp>

namespace rastercheck::rasterizer {

/// The sign, −1, 0 or 1, of the determinant of the columns (x, y, w) of three clip positions: exact
/// for all finite floats, whatever the signs of their w. z has no say.
int determinant_sign(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c);

/// The same determinant with a relative error below 2^-52, and 0 just where it is 0.
double determinant(const glm::vec4& a, const glm::vec4& b, const glm::vec4& c);

}  // namespace rastercheck::rasterizer
