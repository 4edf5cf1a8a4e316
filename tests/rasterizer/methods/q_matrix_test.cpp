// The triangle of these tests, a numerical example of the figure in the Rasterization slides: eye
// C = (1, 2, 3), a = (1, 0, 0), b = (0, 1, 1), c = (−4, −4, 4), corners (u, v; w) = (0, 0; 1), (8,
// 0; 2), (0, 8; 4):
//
//   V1 = C + (−4, −4, 4) = (−3, −2, 7)        [V1−C V2−C V3−C] = columns (−4, −4, 4),
//   V2 = C + 2 (4, −4, 4) = (9, −6, 11)         (8, −8, 8), (−16, 16, 48), det = 4096
//   V3 = C + 4 (−4, 4, 12) = (−15, 18, 51)    clip form: columns (0, 0, 1), (16, 0, 2), (0, 32, 4),
//                                               det = 512
//   Q has the rows (−1/8, −1/8, 1), (1/16, 0, 0), (0, 1/32, 0), the sums −1/16, −3/32, 1.
//
// At (7/2, 5/2): 1/w = 1 − 7/32 − 15/64 = 35/64, k = 7/32 w = 2/5, l = 5/64 w = 1/7.

#include "rasterizer/methods/q_matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "tests/rasterizer/methods/method_draw.h"

namespace rastercheck::rasterizer::q_matrix_test {
namespace {

using Vector = Triple<double>;
using Rows = std::array<Vector, 3>;

constexpr TargetSize kEight{8, 8, 1};
constexpr ImagePlane<double> kImage{{1, 2, 3}, {1, 0, 0}, {0, 1, 1}, {-4, -4, 4}};
constexpr std::array<Vector, 3> kVertices{Vector{-3, -2, 7}, {9, -6, 11}, {-15, 18, 51}};
constexpr std::array<Vector, 3> kColumns{Vector{0, 0, 1}, {16, 0, 2}, {0, 32, 4}};

Vector times(double factor, const Vector& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

Rows q_by_hand(double factor) {
  return {times(factor, {-0.125, -0.125, 1}), times(factor, {0.0625, 0, 0}),
          times(factor, {0, 0.03125, 0})};
}

/// Expects the place given in this file's first lines.
void expect_the_place(const QMatrix<double>& q, double w) {
  const QMatrix<double>::Place place = q.at(3.5, 2.5);
  EXPECT_DOUBLE_EQ(place.k, 2.0 / 5);
  EXPECT_DOUBLE_EQ(place.l, 1.0 / 7);
  EXPECT_DOUBLE_EQ(place.w, w);
}

TEST(QMatrix, OfTheClipForm) {
  const QMatrixResult<double> result = q_matrix(kColumns);
  ASSERT_EQ(result.error, std::nullopt);
  EXPECT_EQ(result.matrix.determinant, 512);
  EXPECT_EQ(result.matrix.rows, q_by_hand(512));
  EXPECT_EQ(result.matrix.sums, times(512, {-0.0625, -0.09375, 1}));
  expect_the_place(result.matrix, 64.0 / 35);
}

// Kills: w derived from the third line of p. 7 as it is printed.
TEST(QMatrix, OfTheCameraForm) {
  const QMatrixResult<double> result = q_matrix(kVertices, kImage);
  ASSERT_EQ(result.error, std::nullopt);
  EXPECT_EQ(result.matrix.determinant, 4096);
  EXPECT_EQ(result.matrix.rows, q_by_hand(4096));
  expect_the_place(result.matrix, 64.0 / 35);
  // P is V1 + (12, −4, 4) 2/5 + (−12, 20, 44)/7, and also C + (c + 7/2 a + 5/2 b) 64/35.
  const QMatrix<double>::Place place = result.matrix.at(3.5, 2.5);
  const Vector expected{3.0 / 35, -26.0 / 35, 521.0 / 35};
  for (std::size_t i = 0; i < 3; ++i) {
    const double in_plane = kVertices[0][i] + (kVertices[1][i] - kVertices[0][i]) * place.k +
                            (kVertices[2][i] - kVertices[0][i]) * place.l;
    const double seen =
        kImage.eye[i] + (kImage.c[i] + 3.5 * kImage.a[i] + 2.5 * kImage.b[i]) * place.w;
    EXPECT_NEAR(in_plane, expected[i], 1e-14);
    EXPECT_NEAR(seen, expected[i], 1e-14);
  }
}

// Kills: a sign of det that is ignored.
TEST(QMatrix, IsPositiveInsideWhicheverWayTheTriangleFaces) {
  std::array<Vector, 3> columns = kColumns;
  std::swap(columns[1], columns[2]);
  const QMatrix<double> q = q_matrix(columns).matrix;
  EXPECT_EQ(q.determinant, 512);
  EXPECT_EQ(q.rows[0], q_by_hand(512)[0]);
  EXPECT_EQ(q.rows[1], q_by_hand(512)[2]);
  EXPECT_EQ(q.rows[2], q_by_hand(512)[1]);
  EXPECT_EQ(q.at(3.5, 2.5).w, 512.0 / 280);
}

// If a, b and c are multiplied by a factor, Q is multiplied by it and w is divided by it; k and l
// stay. A negative factor looks the other way.
TEST(QMatrix, OfAMultipleOfTheImagePlane) {
  for (const double factor : {4.0, 0.25, -1.0}) {
    const ImagePlane<double> image{kImage.eye, times(factor, kImage.a), times(factor, kImage.b),
                                   times(factor, kImage.c)};
    const QMatrixResult<double> result = q_matrix(kVertices, image);
    ASSERT_EQ(result.error, std::nullopt);
    EXPECT_EQ(result.matrix.rows, q_by_hand(4096 * factor));
    expect_the_place(result.matrix, 64.0 / 35 / factor);
  }
}

// V3 is moved to (2, −1, 6), the midpoint between C and the midpoint of V1 and V2.
TEST(QMatrix, ADegenerateMappingIsAnErrorThatSaysSo) {
  std::array<Vector, 3> vertices = kVertices;
  vertices[2] = {2, -1, 6};
  EXPECT_EQ(q_matrix(vertices, kImage).error, QMatrixError::edge_on);
  std::array<Vector, 3> columns = kColumns;
  columns[2] = {16, 0, 3};  // on the line through the first two
  EXPECT_EQ(q_matrix(columns).error, QMatrixError::edge_on);
  ImagePlane<double> image = kImage;
  image.c = {2, 3, 3};  // 2a + 3b
  EXPECT_EQ(q_matrix(kVertices, image).error, QMatrixError::image_plane);
  for (const QMatrixError error : {QMatrixError::edge_on, QMatrixError::image_plane}) {
    EXPECT_NE(to_string(error).find("degenerate"), std::string_view::npos);
  }
}

// Kills: an infinity that goes unnoticed beside a zero.
TEST(QMatrix, NumbersThatAreNotFiniteAreErrors) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double number : {kInfinity, -kInfinity, kNan}) {
    for (std::size_t i = 0; i < 9; ++i) {
      std::array<Vector, 3> columns = kColumns;
      columns[i / 3][i % 3] = number;
      EXPECT_EQ(q_matrix(columns).error, QMatrixError::not_finite) << i;
      std::array<Vector, 3> vertices = kVertices;
      vertices[i / 3][i % 3] = number;
      EXPECT_EQ(q_matrix(vertices, kImage).error, QMatrixError::not_finite) << i;
      ImagePlane<double> image = kImage;
      (i < 3 ? image.eye : i < 6 ? image.a : image.c)[i % 3] = number;
      EXPECT_EQ(q_matrix(kVertices, image).error, QMatrixError::not_finite) << i;
    }
  }
}

/// The triangle as a mesh, with r = 2, 8, 24 at the corners.
SmallMesh drawn_triangle(State& state) {
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1), at(state, 8, 0, 2), at(state, 0, 8, 4)};
  mesh.triangles = {{0, 1, 2}};
  return with_attributes(state, mesh, 1, {2, 8, 24});
}

// r by the last line of p. 7 of the Rasterization slides: its coefficients are −2/8 + 8/16 = 1/4
// for u, −2/8 + 24/32 = 1/2 for v, and the constant 2.
double r_by_hand(double u, double v) { return (u / 4 + v / 2 + 2) / (1 - u / 16 - 3 * v / 32); }

TEST(QMatrix, IsDrawnWith) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    State state = small_state(8, 8, convention);
    const SmallMesh mesh = drawn_triangle(state);
    const Fragments fragments = drawn_by("q-matrix", state, mesh, kEight);
    EXPECT_EQ(fragments.size(), 28U);  // x + y <= 6
    expect_values(fragments, r_by_hand);
    EXPECT_FLOAT_EQ(value_at(fragments, 3, 2), 264.0F / 35);
  }
}

// The second vertex is behind the eye: its clip position is negated, and so is the second row of Q.
// So e = (1 − u/8 − v/8, −u/16, v/32), all three >= 0 where u <= 0 and 0 <= v <= 8 − u. The
// triangle is moved 8 pixels to the right to make that part visible, and u is counted from there.
TEST(QMatrix, AVertexBehindTheEyeIsNoDifferent) {
  State state = small_state(8, 8);
  SmallMesh mesh = drawn_triangle(state);
  for (glm::vec4& p : mesh.positions) p.x += 2 * p.w;  // 8 pixels
  mesh.positions[1] = -mesh.positions[1];
  const Fragments fragments = drawn_by("q-matrix", state, mesh, kEight);
  EXPECT_EQ(fragments.size(), 64U);
  expect_values(fragments, [](double at_u, double v) {
    const double u = at_u - 8;
    return (2 - 3 * u / 4 + v / 2) / (1 - 3 * u / 16 - 3 * v / 32);
  });
}

// S = 224 (u + v) + 1792 and D = 512 − 32 u − 48 v: K is at most 3360/184 < 18.3 on the triangle.
// Kills: double arithmetic that passes for float.
TEST(QMatrix, InFloatKeepsItsPromiseAndNoMore) {
  State state = small_state(8, 8);
  const SmallMesh mesh = drawn_triangle(state);
  const Promise promise = find_method("q-matrix-float")->promise(state, mesh.mesh(), kEight);
  const double most = (promise.smooth.constant + promise.smooth.per_condition * 18.3) * 0x1p-19;
  const Fragments fragments = drawn_by("q-matrix-float", state, mesh, kEight);
  ASSERT_EQ(fragments.size(), 28U);
  int inexact = 0;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const double exact = r_by_hand(fragments.x[i] + 0.5, fragments.y[i] + 0.5);
    const double error = std::abs(fragments.attributes[i] - exact);
    EXPECT_LE(error, most);
    if (error > 0x1.001p-24 * exact) ++inexact;
  }
  EXPECT_GT(inexact, 0);
}

// The triangle of the method's comment with r = 0, 1, 3. The window lies halfway from the first
// vertex to the other two, so that b_1 = 1/2, v = 4 b_1 − 4 b_2 + 12 b_3, b_3 = v/16, r = 1/2 +
// v/8. K = (6 v + 56)/32. Kills: scaling each vertex only by its own power
// of two.
TEST(QMatrix, InFloatDoesNotLoseANeedle) {
  State state = small_state(8, 8);
  SmallMesh mesh;
  constexpr float kW = 0x1p-73F;
  mesh.positions = {{-0x1p127F, 0, 0, kW}, {0x1p127F, -2 * kW, 0, kW}, {0x1p127F, 2 * kW, 0, kW}};
  mesh.triangles = {{0, 1, 2}};
  mesh = with_attributes(state, mesh, 1, {0, 1, 3});
  const Fragments fragments = drawn_by("q-matrix-float", state, mesh, kEight);
  ASSERT_EQ(fragments.size(), 64U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    EXPECT_NEAR(fragments.attributes[i], 0.5 + (fragments.y[i] + 0.5) / 8,
                (1.5 + 82 * 3.25) * 0x1p-22);
  }
}

// The adjugate takes 9 times two products and a difference, and det three products and two sums.
// There are 3 sums of columns, and two differences for each attribute. A place takes D, k and l,
// and two products and two sums for each attribute.
TEST(QMatrix, CountsItsOperations) {
  for (const std::string_view method : {"q-matrix", "q-matrix-float"}) {
    const OperationCounts counts = operations_of(method);
    EXPECT_EQ(counts.per_vertex, Operations{});
    EXPECT_EQ(counts.per_polygon, (Operations{9 + 2 + 6 + 4, 18 + 3, 0}));
    EXPECT_EQ(counts.per_pixel, (Operations{6 + 4, 6 + 4, 2}));
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::q_matrix_test
