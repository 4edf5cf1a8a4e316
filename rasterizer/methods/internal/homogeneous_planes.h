#pragma once

// Formulas for internal/point_drawing.h: parameters as linear functions of homogeneous window
// coordinates (methods/clipless_homogeneous.cpp), and their simpler form for triangles whose three
// w are equal (methods/equal_w.cpp).

#include <array>
#include <cstddef>
#include <span>

#include "rasterizer/methods/internal/point_drawing.h"
#include "rasterizer/methods/q_matrix.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Holds the vertices' coordinates and values. Computes the adjugate's rows, and planes from them.
template <class T>
class HomogeneousTriangle {
 public:
  void set_vertex(std::size_t i, const PointVertex& vertex, std::size_t count) {
    columns_[i] = {T(vertex.x), T(vertex.y), T(vertex.w)};
    for (std::size_t k = 0; k < count; ++k) values_[k][i] = T(vertex.values[k]);
  }

 protected:
  using Rows = std::array<Triple<T>, 3>;

  Rows rows() const { return adjugate(columns_); }

  /// Returns Σ r_i (A_i, B_i, C_i) for an attribute.
  Triple<T> plane_of(std::size_t attribute, const Rows& rows) const {
    Triple<T> plane;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Triple<T> terms{rows[0][axis], rows[1][axis], rows[2][axis]};
      plane[axis] = inner_product(values_[attribute], terms);
    }
    return plane;
  }

  std::array<Triple<T>, kMaxAttributes> planes_;

 private:
  Rows columns_;
  std::array<Triple<T>, kMaxAttributes> values_;  ///< [attribute][vertex]
};

/// r = (a u + b v + c) / (a_1 u + b_1 v + c_1).
template <class T>
class HomogeneousPlanes : public HomogeneousTriangle<T> {
 public:
  void set_up(std::size_t count) {
    const auto rows = this->rows();
    for (std::size_t j = 0; j < 3; ++j) one_[j] = rows[0][j] + rows[1][j] + rows[2][j];
    for (std::size_t k = 0; k < count; ++k) this->planes_[k] = this->plane_of(k, rows);
  }

  void at(T u, T v, std::span<T> values) const {
    const T one = plane_at(one_, u, v);
    for (std::size_t k = 0; k < values.size(); ++k) {
      values[k] = plane_at(this->planes_[k], u, v) / one;
    }
  }

 private:
  Triple<T> one_;
};

/// r = a u + b v + c, for a triangle whose three w are equal.
template <class T>
class UndividedPlanes : public HomogeneousTriangle<T> {
 public:
  void set_up(std::size_t count) {
    const auto rows = this->rows();
    const T one = rows[0][2] + rows[1][2] + rows[2][2];
    for (std::size_t k = 0; k < count; ++k) {
      const Triple<T> plane = this->plane_of(k, rows);
      this->planes_[k] = {plane[0] / one, plane[1] / one, plane[2] / one};
    }
  }

  void at(T u, T v, std::span<T> values) const {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = plane_at(this->planes_[k], u, v);
  }
};

}  // namespace rastercheck::rasterizer
