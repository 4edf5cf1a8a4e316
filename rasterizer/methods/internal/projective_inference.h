#pragma once

// The steps of "the hard way" to texture coordinates (methods/projective_inference.cpp), for any
// number type. Matrices multiply row vectors from the right, as in Heckbert & Moreton 1991.

#include <array>
#include <cstddef>

#include "rasterizer/methods/q_matrix.h"

namespace rastercheck::rasterizer {

/// The rows of a matrix that maps texture space (s, t, 1) to object space (x, y, z, 1).
template <class T>
using TextureToObject = std::array<std::array<T, 4>, 3>;

/// The rows of a matrix that maps object space (x, y, z, 1) to homogeneous window coordinates.
template <class T>
using ObjectToScreen = std::array<Triple<T>, 4>;

/// Texture coordinates of three vertices, [vertex].
template <class T>
struct TextureTriangle {
  Triple<T> s;
  Triple<T> t;
};

/// Returns the affine map from the vertices' texture coordinates to their positions. Its rows are
/// ∂/∂s, ∂/∂t and the position of (0, 0).
template <class T>
TextureToObject<T> infer_parameterization(const TextureTriangle<T>& texture,
                                          const std::array<Triple<T>, 3>& positions) {
  const T s1 = texture.s[1] - texture.s[0];
  const T s2 = texture.s[2] - texture.s[0];
  const T t1 = texture.t[1] - texture.t[0];
  const T t2 = texture.t[2] - texture.t[0];
  const T determinant = s1 * t2 - s2 * t1;
  TextureToObject<T> map;
  for (std::size_t j = 0; j < 3; ++j) {
    const T p1 = positions[1][j] - positions[0][j];
    const T p2 = positions[2][j] - positions[0][j];
    map[0][j] = (t2 * p1 - t1 * p2) / determinant;
    map[1][j] = (s1 * p2 - s2 * p1) / determinant;
    map[2][j] = positions[0][j] - texture.s[0] * map[0][j] - texture.t[0] * map[1][j];
  }
  map[0][3] = T(0);
  map[1][3] = T(0);
  map[2][3] = T(1);
  return map;
}

/// Returns the rows of the product of both matrices, which maps texture space to homogeneous window
/// coordinates.
template <class T>
std::array<Triple<T>, 3> concatenate(const TextureToObject<T>& first,
                                     const ObjectToScreen<T>& second) {
  std::array<Triple<T>, 3> product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product[i][j] = first[i][0] * second[0][j] + first[i][1] * second[1][j] +
                      first[i][2] * second[2][j] + first[i][3] * second[3][j];
    }
  }
  return product;
}

/// Returns the columns of the inverse, up to a factor: planes whose values at (x, y) are (s q, t q,
/// q).
template <class T>
std::array<Triple<T>, 3> screen_to_texture(const std::array<Triple<T>, 3>& texture_to_screen) {
  // The matrix is given by its rows. The columns of its adjugate are the rows of its transpose's
  // adjugate.
  return adjugate(texture_to_screen);
}

/// Returns (x, y, 1) times the matrix with these columns.
template <class T>
Triple<T> transform(const std::array<Triple<T>, 3>& columns, T x, T y) {
  return {plane_at(columns[0], x, y), plane_at(columns[1], x, y), plane_at(columns[2], x, y)};
}

}  // namespace rastercheck::rasterizer
