#pragma once

// The q-matrix (Rasterization slides, pp. 6–7), which maps a place of the image to a triangle's own
// coordinates.
//
// A point of the triangle is P = V1 + (V2 − V1) k + (V3 − V1) l, and a place (u, v) of the image
// sees P = C + (c + u a + v b) w, with C the eye, a and b along the image's axes and c to its
// origin. (This is the second line of p. 7. The third line, which is the second with V1 and C moved
// to the left, lacks the factor w on u and v, and so does the fourth. The formula for w below them
// does not follow from the printed lines.) Together
//
//   [V1−C V2−C V3−C] (1−k−l, k, l)^T = [a b c] (u w, v w, w)^T,
//
//   Q = [V1−C V2−C V3−C]^-1 [a b c],   e = Q (u, v, 1)^T,
//
//   w = 1 / (e_1 + e_2 + e_3),   k = w e_2,   l = w e_3,   1 − k − l = w e_1.
//
// This is the camera form. In the clip form V − C is given as homogeneous window coordinates, M =
// columns (X_i, Y_i, w_i) = (u_i w_i, v_i w_i, w_i), with a, b and c as their axes: Q = M^-1. This
// equals the camera form's Q if [a b c] inverts the map from V − C to (X, Y, w). If [a b c] inverts
// a multiple of that map, the two Q differ by a factor; w then has the inverse factor, and k and l
// are the same.
//
// QMatrix holds a multiple of Q, which needs no division. It uses the adjugate, whose rows are
// vector products:
//
//   |det M| Q = sign(det M) adj(M) [a b c],     row i of adj(M) = column j × column k,
//
// (i, j, k) in cyclic order. All components of e are >= 0 inside the triangle and w > 0 in front of
// the eye, whichever way the triangle faces.
//
// The test for det M = 0 is not exact: it uses the computed determinant. T is a number type whose
// range must hold products of three of the inputs (in the camera form, of four).

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rastercheck::rasterizer {

template <class T>
using Triple = std::array<T, 3>;

template <class T>
Triple<T> cross_product(const Triple<T>& a, const Triple<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T>
T inner_product(const Triple<T>& a, const Triple<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Triple<T> difference(const Triple<T>& a, const Triple<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Returns the rows of the adjugate of a matrix given by its columns.
template <class T>
std::array<Triple<T>, 3> adjugate(const std::array<Triple<T>, 3>& columns) {
  return {cross_product(columns[1], columns[2]), cross_product(columns[2], columns[0]),
          cross_product(columns[0], columns[1])};
}

/// Returns a u + b v + c for a row (a, b, c).
template <class T>
T plane_at(const Triple<T>& row, T u, T v) {
  return row[0] * u + row[1] * v + row[2];
}

template <class T>
struct QMatrix {
  std::array<Triple<T>, 3> rows;  ///< the rows of |det M| Q
  Triple<T> sums;                 ///< |det M| (q_1j + q_2j + q_3j)
  T determinant;                  ///< |det M|

  struct Place {
    T k;
    T l;
    T w;
  };

  /// Returns |det M| / w.
  T denominator(T u, T v) const { return plane_at(sums, u, v); }

  /// Returns k, l and w at a place of the image. The denominator there must not be 0: the place
  /// must see the triangle's plane. The denominator is positive in front of the eye.
  Place at(T u, T v) const {
    const T d = denominator(u, v);
    return {plane_at(rows[1], u, v) / d, plane_at(rows[2], u, v) / d, determinant / d};
  }
};

/// The eye C and the image's axes and origin: (u, v) looks along c + u a + v b.
template <class T>
struct ImagePlane {
  Triple<T> eye;
  Triple<T> a;
  Triple<T> b;
  Triple<T> c;
};

/// Why a triangle has no q-matrix.
enum class QMatrixError {
  edge_on,      ///< det M = 0: the eye lies in the triangle's plane
  image_plane,  ///< det [a b c] = 0: the eye lies in the image's plane
  not_finite,   ///< an input is infinite or NaN, or a product exceeds T's range
};

constexpr std::string_view to_string(QMatrixError error) {
  switch (error) {
    case QMatrixError::edge_on:
      return "the mapping is degenerate: the eye lies in the plane of the triangle, det M = 0";
    case QMatrixError::image_plane:
      return "the mapping is degenerate: the eye lies in the plane of the image, det [a b c] = 0";
    case QMatrixError::not_finite:
      return "a number is not finite, or a product of such numbers is not";
  }
  return "";
}

template <class T>
struct QMatrixResult {
  std::optional<QMatrixError> error;
  QMatrix<T> matrix;  ///< meaningless if `error` is set
};

/// Makes a QMatrix from the rows of adj(M) [a b c] and det M, without checks.
template <class T>
QMatrix<T> assemble_q_matrix(const std::array<Triple<T>, 3>& rows, T determinant) {
  QMatrix<T> q{rows, {}, determinant};
  if (determinant < T(0)) {
    q.determinant = -determinant;
    for (Triple<T>& row : q.rows) row = {-row[0], -row[1], -row[2]};
  }
  for (std::size_t j = 0; j < 3; ++j) q.sums[j] = q.rows[0][j] + q.rows[1][j] + q.rows[2][j];
  return q;
}

/// Makes the clip form from columns (X_i, Y_i, w_i), without checks. The exact determinant must be
/// known not to be 0; then only its computed sign may be wrong.
template <class T>
QMatrix<T> q_matrix_of_columns(const std::array<Triple<T>, 3>& columns) {
  const std::array<Triple<T>, 3> rows = adjugate(columns);
  return assemble_q_matrix(rows, inner_product(columns[0], rows[0]));
}

/// Returns the error of a determinant: `if_zero` if it is 0, not_finite if it is not finite.
template <class T>
std::optional<QMatrixError> determinant_error(T determinant, QMatrixError if_zero) {
  const auto value = static_cast<double>(determinant);
  if (!std::isfinite(value)) return QMatrixError::not_finite;
  if (value == 0) return if_zero;
  return std::nullopt;
}

/// Makes the clip form from columns (X_i, Y_i, w_i).
template <class T>
QMatrixResult<T> q_matrix(const std::array<Triple<T>, 3>& columns) {
  QMatrixResult<T> result;
  result.matrix = q_matrix_of_columns(columns);
  result.error = determinant_error(result.matrix.determinant, QMatrixError::edge_on);
  return result;
}

/// Makes the camera form from vertices V1, V2 and V3.
template <class T>
QMatrixResult<T> q_matrix(const std::array<Triple<T>, 3>& vertices, const ImagePlane<T>& image) {
  std::array<Triple<T>, 3> columns;
  for (std::size_t i = 0; i < 3; ++i) columns[i] = difference(vertices[i], image.eye);
  const std::array<Triple<T>, 3> inverse = adjugate(columns);
  std::array<Triple<T>, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] = {inner_product(inverse[i], image.a), inner_product(inverse[i], image.b),
               inner_product(inverse[i], image.c)};
  }
  QMatrixResult<T> result;
  result.matrix = assemble_q_matrix(rows, inner_product(columns[0], inverse[0]));
  result.error = determinant_error(result.matrix.determinant, QMatrixError::edge_on);
  const T volume = inner_product(image.a, cross_product(image.b, image.c));
  if (!result.error) result.error = determinant_error(volume, QMatrixError::image_plane);
  return result;
}

}  // namespace rastercheck::rasterizer
