#include "rasterizer/vertex_stage.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "rasterizer/internal/determinant.h"
#include "rasterizer/internal/exact_sum.h"
#include "rasterizer/internal/try_allocating.h"

namespace rastercheck::rasterizer {
namespace {

using Column = std::array<double, 4>;
using Matrix = std::array<Column, 4>;  ///< [column][row]

/// The product of a row and a column. Because terms are summed in pairs, the sums add only two
/// roundings to each term.
double sum_of_products(const Column& row, const Column& column) {
  return (row[0] * column[0] + row[1] * column[1]) + (row[2] * column[2] + row[3] * column[3]);
}

Matrix in_double(const glm::mat4& matrix) {
  Matrix result{};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t r = 0; r < 4; ++r) {
      result[c][r] = double{matrix[static_cast<glm::length_t>(c)][static_cast<glm::length_t>(r)]};
    }
  }
  return result;
}

Column row_of(const Matrix& matrix, std::size_t row) {
  return {matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]};
}

Matrix product(const Matrix& left, const Matrix& right) {
  Matrix result{};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t r = 0; r < 4; ++r) {
      result[c][r] = sum_of_products(row_of(left, r), right[c]);
    }
  }
  return result;
}

Column in_double(const glm::vec4& p) {
  return {double{p.x}, double{p.y}, double{p.z}, double{p.w}};
}
Column in_double(const glm::vec3& p) { return {double{p.x}, double{p.y}, double{p.z}, 1}; }

/// Enlarges `all` by `count` elements. Returns an error, with `all` unchanged, if memory runs out.
template <typename T>
std::optional<Error> append_room(std::vector<T>& all, std::size_t count) {
  return try_allocating([&] { all.resize(all.size() + count); });
}

template <typename Position>
std::optional<Error> transform_any(const Camera& camera, std::span<const Position> positions,
                                   std::vector<glm::vec4>& clip) {
  const std::size_t first = clip.size();
  if (const auto error = append_room(clip, positions.size())) return error;
  const Matrix view_model = product(in_double(camera.view), in_double(camera.model));
  const Matrix all = product(in_double(camera.projection), view_model);
  const std::array<Column, 4> rows{row_of(all, 0), row_of(all, 1), row_of(all, 2), row_of(all, 3)};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Column p = in_double(positions[i]);
    clip[first + i] = {static_cast<float>(sum_of_products(rows[0], p)),
                       static_cast<float>(sum_of_products(rows[1], p)),
                       static_cast<float>(sum_of_products(rows[2], p)),
                       static_cast<float>(sum_of_products(rows[3], p))};
  }
  return std::nullopt;
}

using Vector = std::array<double, 3>;
using Matrix3 = std::array<Vector, 3>;  ///< [row][column]

/// An element of the upper left 3×3 part, with cyclic indices.
double element(const glm::mat4& model, std::size_t row, std::size_t column) {
  return double{model[static_cast<glm::length_t>(column % 3)][static_cast<glm::length_t>(row % 3)]};
}

/// The sign of the determinant of the upper left 3×3 part; empty if an element is not finite.
std::optional<int> orientation(const glm::mat4& model) {
  const auto column = [&model](glm::length_t c) {
    return glm::vec4(model[c].x, model[c].y, 0, model[c].z);
  };
  bool is_finite = true;
  for (glm::length_t c = 0; c < 3; ++c) {
    is_finite = is_finite && std::isfinite(model[c].x) && std::isfinite(model[c].y) &&
                std::isfinite(model[c].z);
  }
  if (!is_finite) return std::nullopt;
  return determinant_sign(column(0), column(1), column(2));
}

/// The cofactors of the upper left 3×3 part, negated if `is_mirrored`.
Matrix3 cofactors(const glm::mat4& model, bool is_mirrored) {
  const auto a = [&model](std::size_t row, std::size_t column) {
    return element(model, row, column);
  };
  Matrix3 result{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      // Cyclic indices include the cofactor's sign.
      const double cofactor = a(r + 1, c + 1) * a(r + 2, c + 2) - a(r + 1, c + 2) * a(r + 2, c + 1);
      result[r][c] = is_mirrored ? -cofactor : cofactor;
    }
  }
  return result;
}

Vector image(const Matrix3& matrix, const glm::vec3& n) {
  Vector m{};
  for (std::size_t r = 0; r < 3; ++r) {
    m[r] = (matrix[r][0] * double{n.x} + matrix[r][1] * double{n.y}) + matrix[r][2] * double{n.z};
  }
  return m;
}

/// C n for the cofactors C, summed without rounding. All numbers must be finite.
Vector exact_image(const glm::mat4& model, const glm::vec3& n) {
  const auto a = [&model](std::size_t row, std::size_t column) {
    return element(model, row, column);
  };
  Vector m{};
  for (std::size_t r = 0; r < 3; ++r) {
    ExactSum sum;
    for (std::size_t c = 0; c < 3; ++c) {
      const double of_normal{n[static_cast<glm::length_t>(c)]};
      // Products of two floats are exact.
      sum.add_product(a(r + 1, c + 1) * a(r + 2, c + 2), of_normal);
      sum.add_product(-(a(r + 1, c + 2) * a(r + 2, c + 1)), of_normal);
    }
    m[r] = sum.nearest();
  }
  return m;
}

glm::vec3 unit(const Vector& m) {
  const double squares = (m[0] * m[0] + m[1] * m[1]) + m[2] * m[2];
  // A model element that is not finite affects at least two components of m.
  if (squares == 0 || !std::isfinite(squares)) return {0, 0, 0};
  const double length = std::sqrt(squares);
  return {static_cast<float>(m[0] / length), static_cast<float>(m[1] / length),
          static_cast<float>(m[2] / length)};
}

}  // namespace

std::optional<Error> transform(const Camera& camera, std::span<const glm::vec4> positions,
                               std::vector<glm::vec4>& clip) {
  return transform_any(camera, positions, clip);
}

std::optional<Error> transform(const Camera& camera, std::span<const glm::vec3> positions,
                               std::vector<glm::vec4>& clip) {
  return transform_any(camera, positions, clip);
}

std::optional<Error> transform_normals(const glm::mat4& model, std::span<const glm::vec3> normals,
                                       std::vector<glm::vec3>& world) {
  const std::size_t first = world.size();
  if (const auto error = append_room(world, normals.size())) return error;
  const std::optional<int> sign = orientation(model);
  const Matrix3 matrix = cofactors(model, sign && *sign < 0);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::vec3& n = normals[i];
    const bool is_finite = std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z);
    // For a singular model sums may be exactly zero; rounding errors must not become a direction.
    const bool is_summed_exactly = sign == 0 && is_finite;
    world[first + i] = unit(is_summed_exactly ? exact_image(model, n) : image(matrix, n));
  }
  return std::nullopt;
}

}  // namespace rastercheck::rasterizer
