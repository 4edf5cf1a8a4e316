#include "properties/camera_matrices.h"

#include <algorithm>

namespace rastercheck::properties {

using cases::Matrix4;

Matrix4 translation(float x, float y, float z) {
  return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1};
}

Matrix4 rotation(std::size_t axis, float t) {
  const double square = double{t} * double{t};
  const auto cosine = static_cast<float>((1 - square) / (1 + square));
  const auto sine = static_cast<float>(2 * double{t} / (1 + square));
  const std::size_t a = (axis + 1) % 3;
  const std::size_t b = (axis + 2) % 3;
  Matrix4 matrix = cases::kIdentity;
  matrix[a * 4 + a] = cosine;
  matrix[a * 4 + b] = -sine;
  matrix[b * 4 + a] = sine;
  matrix[b * 4 + b] = cosine;
  return matrix;
}

Matrix4 any_matrix(Draw& draw, int exponent) {
  Matrix4 matrix{};
  for (float& number : matrix) {
    number = draw.one_in(8) ? 0.0F : draw.spread(std::max(exponent - 3, -149), exponent);
  }
  return matrix;
}

}  // namespace rastercheck::properties
