#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rasterizer/methods/internal/homogeneous_planes.h"
#include "tests/rasterizer/exact.h"
#include "tests/rasterizer/methods/method_draw.h"

namespace rastercheck::rasterizer::equal_w_test {
namespace {

constexpr TargetSize kEight{8, 8, 1};
constexpr std::string_view kMethod = "equal-w";

// r is 0, 1, 2 at (0, 0), (8, 0), (0, 8), so r = u/8 + v/4. The divisor is 64 w².
TEST(EqualW, IsExactOnSimpleTriangles) {
  for (const float w : {1.0F, 2.0F, 0.25F}) {
    State state = small_state(8, 8);
    SmallMesh mesh;
    mesh.positions = {at(state, 0, 0, w), at(state, 8, 0, w), at(state, 0, 8, w)};
    mesh.triangles = {{0, 1, 2}};
    mesh = with_attributes(state, mesh, 1, {0, 1, 2});
    const Fragments fragments = drawn_by(kMethod, state, mesh, {8, 8, 4});
    ASSERT_GT(fragments.size(), 100U);
    const Fragments center = drawn_by(kMethod, state, mesh, kEight);
    for (std::size_t i = 0; i < center.size(); ++i) {
      const float u = static_cast<float>(center.x[i]) + 0.5F;
      const float v = static_cast<float>(center.y[i]) + 0.5F;
      EXPECT_EQ(center.attributes[i], u / 8 + v / 4) << w;
    }
  }
}

// e = (1 − (u + v)/8, u/8, v/8) divided by (w_1, w_2, w_3), of which one is 2 and the others are 1;
// r = 2, 8, 24. Kills: a comparison of two w that leaves out the third.
TEST(EqualW, DividesWhereOneWDiffers) {
  for (std::size_t odd = 0; odd < 3; ++odd) {
    State state = small_state(8, 8);
    std::array<float, 3> w{1, 1, 1};
    w[odd] = 2;
    SmallMesh mesh;
    mesh.positions = {at(state, 0, 0, w[0]), at(state, 8, 0, w[1]), at(state, 0, 8, w[2])};
    mesh.triangles = {{0, 1, 2}};
    mesh = with_attributes(state, mesh, 1, {2, 8, 24});
    const Fragments fragments = drawn_by(kMethod, state, mesh, kEight);
    expect_values(fragments, [&w](double u, double v) {
      const std::array<double, 3> e{(8 - u - v) / w[0], u / w[1], v / w[2]};
      return (2 * e[0] + 8 * e[1] + 24 * e[2]) / (e[0] + e[1] + e[2]);
    });
  }
}

/// A triangle around the window's middle with equal w; some are slivers.
std::array<PointVertex, 3> random_triangle(Random& random) {
  std::array<PointVertex, 3> vertices;
  const double w = std::abs(random.number(24, -20, 20));
  const int thinness = random.between(0, 20);
  for (PointVertex& vertex : vertices) {
    vertex.w = w;
    vertex.x = random.number(53, -2, 4) * w;
    vertex.y = vertex.x + std::ldexp(random.number(53, -2, 4) * w, -thinness);
    vertex.values[0] = random.real(-20, 0);
  }
  return vertices;
}

/// D and K as in the method's comment, for vertices with exact coordinates.
struct Conditioning {
  long double determinant = 0;
  long double k = 0;
};

Conditioning conditioning(const std::array<PointVertex, 3>& vertices, double u, double v) {
  Conditioning result;
  long double sizes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const PointVertex& p = vertices[(i + 1) % 3];
    const PointVertex& q = vertices[(i + 2) % 3];
    result.determinant += static_cast<long double>(p.x) * q.y - static_cast<long double>(q.x) * p.y;
    const auto size = [](long double a, long double b) { return std::abs(a * b); };
    sizes += (size(p.y, q.w) + size(q.y, p.w)) * std::abs(u) +
             (size(p.x, q.w) + size(q.x, p.w)) * std::abs(v) + size(p.x, q.y) + size(q.x, p.y);
  }
  result.k = sizes / std::abs(result.determinant);
  return result;
}

// The bound is (100 u K + 2 u) M, from the method's comment. Long double finds K to about 2^-64 K².
// Kills: a way with a larger error; a bound that is never approached.
TEST(EqualW, TheTwoWaysDifferByNoMoreThanTheyMay) {
  constexpr double kU = kDoubleRoundoff;
  Random random(1);
  int different = 0;
  double greatest = 0;
  for (int i = 0; i < 50'000; ++i) {
    const std::array<PointVertex, 3> vertices = random_triangle(random);
    const double u = random.between(0, 16 * 16) / 16.0;
    const double v = random.between(0, 16 * 16) / 16.0;
    const Conditioning condition = conditioning(vertices, u, v);
    if (!(condition.k < 0x1p30L)) continue;
    PointFormulaOf<UndividedPlanes, double> undivided;
    PointFormulaOf<HomogeneousPlanes, double> general;
    undivided.set(vertices, 1);
    general.set(vertices, 1);
    std::array<double, 1> a;
    std::array<double, 1> b;
    undivided.at(u, v, a);
    general.at(u, v, b);
    double m = std::max(std::abs(a[0]), std::abs(b[0]));
    for (const PointVertex& vertex : vertices) m = std::max(m, std::abs(vertex.values[0]));
    const double most = (100 * static_cast<double>(condition.k) + 2) * kU * m;
    EXPECT_LE(std::abs(a[0] - b[0]), most);
    if (a[0] != b[0]) ++different;
    greatest = std::max(greatest, std::abs(a[0] - b[0]) / most);
  }
  EXPECT_GT(different, 20'000);
  EXPECT_GT(greatest, 0.01);
}

// Drawn values differ by at most one more unit of the greatest value.
TEST(EqualW, DrawsWhatTheGeneralFormDraws) {
  Random random(2);
  std::size_t compared = 0;
  for (int i = 0; i < 300; ++i) {
    State state = small_state(8, 8);
    SmallMesh mesh;
    const float w = std::abs(static_cast<float>(random.number(24, -4, 4)));
    const auto place = [&random] { return static_cast<float>(random.between(-16, 144)) / 16; };
    for (int k = 0; k < 3; ++k) {
      const float u = place();
      mesh.positions.push_back(at(state, u, place(), w));
    }
    mesh.triangles = {{0, 1, 2}};
    mesh = with_attributes(state, mesh, 1, {random.real(-4, 0), random.real(-4, 0), 1});
    const Fragments drawn = drawn_by(kMethod, state, mesh, kEight);
    const Fragments general = drawn_by("clipless-homogeneous", state, mesh, kEight);
    ASSERT_EQ(drawn.size(), general.size());
    compared += drawn.size();
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      EXPECT_NEAR(drawn.attributes[k], general.attributes[k], 0x1.01p-23);
    }
  }
  EXPECT_GT(compared, 1'000U);
}

// As for clipless-homogeneous, with two differences: the plane of 1 does not need its first two
// coefficients, and there are three quotients for each attribute but none at a place.
TEST(EqualW, CountsItsOperations) {
  const OperationCounts counts = operations_of(kMethod);
  EXPECT_EQ(counts.per_vertex, Operations{});
  EXPECT_EQ(counts.per_polygon, (Operations{9 + 2 + 2 * 6, 18 + 2 * 9, 6}));
  EXPECT_EQ(counts.per_pixel, (Operations{2 * 2, 2 * 2, 0}));
}

}  // namespace
}  // namespace rastercheck::rasterizer::equal_w_test
