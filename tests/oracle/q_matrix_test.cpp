// Compares the rasterizer's q-matrix (rasterizer/methods/q_matrix.h) with the exact camera form,
// solved by elimination (oracle/internal/camera_form.h): for small integers both are exact.

#include "rasterizer/methods/q_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "oracle/internal/camera_form.h"

namespace rastercheck::oracle::q_matrix_test {
namespace {

using rasterizer::QMatrixError;
using rasterizer::QMatrixResult;
using rasterizer::Triple;

/// Integers from −12 to 12, the same in every run.
class SmallNumbers {
 public:
  Triple<double> triple() { return {next(), next(), next()}; }
  double next() { return static_cast<double>(static_cast<int>(engine_() % 25) - 12); }

 private:
  std::mt19937 engine_{1};
};

FieldVector3 exact(const Triple<double>& v) { return {Field(v[0]), Field(v[1]), Field(v[2])}; }

/// Q, from a result that holds |det M| Q.
FieldMatrix3 quotient_of(const QMatrixResult<double>& result) {
  FieldMatrix3 q;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto row = static_cast<std::size_t>(i);
      q(i, j) = Field(result.matrix.rows[row][static_cast<std::size_t>(j)]) /
                Field(result.matrix.determinant);
    }
  }
  return q;
}

struct Scene {
  std::array<Triple<double>, 3> vertices;
  rasterizer::ImagePlane<double> image;
};

Scene random_scene(SmallNumbers& numbers) {
  Scene scene;
  for (Triple<double>& vertex : scene.vertices) vertex = numbers.triple();
  scene.image = {numbers.triple(), numbers.triple(), numbers.triple(), numbers.triple()};
  return scene;
}

FieldMatrix3 axes_of(const rasterizer::ImagePlane<double>& image) {
  FieldMatrix3 axes;
  axes.col(0) = exact(image.a);
  axes.col(1) = exact(image.b);
  axes.col(2) = exact(image.c);
  return axes;
}

std::optional<FieldMatrix3> exact_q(const Scene& scene) {
  const ImagePlane plane{exact(scene.image.eye), exact(scene.image.a), exact(scene.image.b),
                         exact(scene.image.c)};
  return q_matrix({exact(scene.vertices[0]), exact(scene.vertices[1]), exact(scene.vertices[2])},
                  plane);
}

// Kills: a transposed matrix; a wrong sign of det; degenerate mappings that are missed.
TEST(QMatrix, OfTheCameraFormIsTheExactOne) {
  SmallNumbers numbers;
  int regular = 0;
  int degenerate = 0;
  for (int i = 0; i < 2'000; ++i) {
    Scene scene = random_scene(numbers);
    if (i % 10 == 0) scene.vertices[2] = scene.vertices[i % 20 == 0 ? 0 : 1];
    if (i % 25 == 0) scene.image.c = scene.image.b;
    const QMatrixResult<double> result = rasterizer::q_matrix(scene.vertices, scene.image);
    const std::optional<FieldMatrix3> q = exact_q(scene);
    if (!q) {
      EXPECT_EQ(result.error, QMatrixError::edge_on);
      ++degenerate;
    } else if (axes_of(scene.image).determinant() == Field(0)) {
      EXPECT_EQ(result.error, QMatrixError::image_plane);
      ++degenerate;
    } else {
      ASSERT_EQ(result.error, std::nullopt);
      EXPECT_GT(result.matrix.determinant, 0);
      EXPECT_TRUE(quotient_of(result) == *q) << *q;
      ++regular;
    }
  }
  EXPECT_GT(regular, 1'500);
  EXPECT_GT(degenerate, 200);
}

// (X, Y, w) of a vertex is [a b c]^-1 (V − C), which has integer coordinates if det [a b c] is ±1.
// Kills: rows of the clip form that are not in the order of the vertices.
TEST(QMatrix, OfTheClipFormIsThatOfTheCameraForm) {
  SmallNumbers numbers;
  int regular = 0;
  for (int i = 0; i < 1'000; ++i) {
    Scene scene = random_scene(numbers);
    // The product of a lower and an upper triangular matrix with ones on their diagonals, and a
    // sign.
    const Triple<double> low = numbers.triple();
    const Triple<double> up = numbers.triple();
    const double sign = i % 2 == 0 ? 1 : -1;
    scene.image.a = {sign, sign * low[0], sign * low[1]};
    scene.image.b = {up[0], low[0] * up[0] + 1, low[1] * up[0] + low[2]};
    scene.image.c = {up[1], low[0] * up[1] + up[2], low[1] * up[1] + low[2] * up[2] + 1};
    const FieldMatrix3 inverse = axes_of(scene.image).inverse();
    std::array<Triple<double>, 3> columns;
    for (std::size_t k = 0; k < 3; ++k) {
      const FieldVector3 column =
          inverse * FieldVector3(exact(scene.vertices[k]) - exact(scene.image.eye));
      for (int j = 0; j < 3; ++j) {
        columns[k][static_cast<std::size_t>(j)] = CGAL::to_double(column[j]);
      }
      ASSERT_TRUE(exact(columns[k]) == column);
    }
    const QMatrixResult<double> result = rasterizer::q_matrix(columns);
    const std::optional<FieldMatrix3> q = exact_q(scene);
    ASSERT_EQ(result.error == QMatrixError::edge_on, !q);
    if (!q) continue;
    EXPECT_TRUE(quotient_of(result) == *q) << *q;
    ++regular;
  }
  EXPECT_GT(regular, 900);
}

}  // namespace
}  // namespace rastercheck::oracle::q_matrix_test
