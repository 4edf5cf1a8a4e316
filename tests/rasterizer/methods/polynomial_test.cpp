// polynomial-quadratic and polynomial-cubic, checked against values computed by hand, and their
// errors compared with the share of the range that they promise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "rasterizer/methods/method.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::polynomial_test {
namespace {

/// The pixels of the only row. Its span covers all of it except for 2^-13 of the width.
constexpr int kWidth = 1024;
constexpr TargetSize kRow{kWidth, 1, 1};

State with_one_attribute() {
  State state = small_state(kWidth, 1);
  state.attributes = {{}};
  return state;
}

/// A mesh with w from 1 to `ratio` and the attribute from 0 to 1 along the row.
SmallMesh along_the_row(const State& state, float ratio) {
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1), at(state, kWidth, 0, ratio), at(state, 0, 4096, 1)};
  mesh.attributes = {0, 1, 0};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Fragments drawn_by(std::string_view method, const State& state, const SmallMesh& mesh) {
  Fragments fragments;
  EXPECT_FALSE(draw_fragments_by(method, state, mesh.mesh(), kRow, fragments).error);
  EXPECT_GE(fragments.size(), static_cast<std::size_t>(kWidth) - 1);
  return fragments;
}

double share(std::string_view method, float ratio) {
  const State state = with_one_attribute();
  const SmallMesh mesh = along_the_row(state, ratio);
  return find_method(method)->promise(state, mesh.mesh(), kRow).smooth.range_share;
}

/// The worst error, in units of the range, which is 1.
double worst_error(std::string_view method, float ratio) {
  const State state = with_one_attribute();
  const Fragments fragments = drawn_by(method, state, along_the_row(state, ratio));
  double worst = 0;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const double t = (fragments.x[i] + 0.5) / kWidth;
    const double exact = t / double{ratio} / (1 - t + t / double{ratio});
    worst = std::max(worst, std::abs(double{fragments.attributes[i]} - exact));
  }
  return worst;
}

// By hand, for the whole span: with w from 1 to 3, r = t/(3 − 2 t), which is 0, 1/4 and 1 at t = 0,
// 1/2 and 1, and so is t². At t = 1/3 and 2/3, r is 1/7 and 2/5, and (36 t³ − 18 t² + 17 t)/35 has
// all four values. The row's span is shorter by 2^-13, and the values differ by at most that times
// a slope of 3.
TEST(Polynomial, GoesThroughTheNodes) {
  const State state = with_one_attribute();
  const SmallMesh mesh = along_the_row(state, 3);
  const Fragments quadratic = drawn_by("polynomial-quadratic", state, mesh);
  const Fragments cubic = drawn_by("polynomial-cubic", state, mesh);
  for (std::size_t i = 0; i < quadratic.size(); ++i) {
    const double t = (quadratic.x[i] + 0.5) / kWidth;
    EXPECT_NEAR(quadratic.attributes[i], t * t, 3 * 0x1p-13);
    EXPECT_NEAR(cubic.attributes[i], (36 * t * t * t - 18 * t * t + 17 * t) / 35, 3 * 0x1p-13);
  }
}

// By hand, with q = 1/(ρ − 1). The promise is the smaller of two bounds. For ρ = 3, q = 1/2, and
// the first bound is the smaller: √3/36 / (1/2 · 1) = √3/18 < 1/2 for quadratic, and 1/81 / (1/2 ·
// 5/6 · 7/6) = 8/315 < 2/9 / (5/6 · 7/6) for cubic. For ρ = 2^20 + 1 the second is the smaller.
TEST(Polynomial, PromisesASmallShareOfTheRange) {
  const auto near = [](double expected) { return std::pair(expected, expected * (1 + 0x1p-19)); };
  const auto expect = [](double actual, const std::pair<double, double>& range) {
    EXPECT_GE(actual, range.first * (1 - 0x1p-40));
    EXPECT_LE(actual, range.second);
  };
  expect(share("polynomial-quadratic", 3), near(std::sqrt(3.0) / 18));
  expect(share("polynomial-cubic", 3), near(8.0 / 315));
  const double q = 0x1p-20;
  expect(share("polynomial-quadratic", 0x1p20F + 1), near(0.5 / (q + 0.5)));
  expect(share("polynomial-cubic", 0x1p20F + 1), near(2.0 / 9 / ((q + 1.0 / 3) * (q + 2.0 / 3))));
  EXPECT_EQ(share("polynomial-quadratic", 1), 0);
  EXPECT_EQ(share("polynomial-cubic", 1), 0);
  EXPECT_EQ(share("polynomial-quadratic", -1), 1);
  EXPECT_EQ(share("polynomial-cubic", 0), 1);
}

// Kills: a promise that is broken; a promise that says nothing. The promised shares of the range
// are never exceeded. Where pixels are dense enough to meet the worst place, they are never more
// than three times too large.
TEST(Polynomial, IsOffByNearlyWhatItPromises) {
  for (const std::string_view name : {"polynomial-quadratic", "polynomial-cubic"}) {
    for (const float ratio : {1.0625F, 1.5F, 2.0F, 4.0F, 16.0F, 256.0F, 0x1p20F}) {
      const double worst = worst_error(name, ratio);
      EXPECT_LE(worst, share(name, ratio) + 0x1p-24) << name << " " << ratio;
      if (ratio < 256) {
        EXPECT_GE(3 * worst, share(name, ratio)) << name << " " << ratio;
      }
    }
  }
}

// By hand, with t counted from the far end and the pole at t = −q, q = 1/255: r goes nine tenths of
// its way within the first 4% of the row. The error of quadratic, t/(t + q) · |(t − 1/2)(t − 1)|/(q
// + 1/2), is 0.801 at t = 0.035, and that of cubic is 0.737 at t = 0.025. The span begins 2^-13 of
// the row after the vertex, so that only 1/(1 + 2^-13/q) = 0.970 of the way lies within the span.
TEST(Polynomial, FailsNearThePole) {
  EXPECT_GE(worst_error("polynomial-quadratic", 256), 0.77);
  EXPECT_GE(worst_error("polynomial-cubic", 256), 0.71);
}

// Wolberg's polynomials are of use where w changes little: each halving of ρ − 1 divides the error
// by nearly 4 for quadratic and by nearly 8 for cubic.
TEST(Polynomial, ConvergesWithItsDegree) {
  const auto quotient = [](std::string_view name) {
    return worst_error(name, 1.25F) / worst_error(name, 1.125F);
  };
  EXPECT_NEAR(quotient("polynomial-quadratic"), 4, 0.5);
  EXPECT_NEAR(quotient("polynomial-cubic"), 8, 1.5);
}

// By hand. Quadratic: each of three parameters takes three nodes of two products and a sum, and six
// divisions give the values at the nodes; d_1, d_2 and the coefficients follow. A pixel takes its
// place, and two products and two sums for each attribute, but no division.
TEST(Polynomial, DividesPerRowAndNotPerPixel) {
  const OperationCounts quadratic = find_method("polynomial-quadratic")->operations();
  EXPECT_EQ(quadratic.per_vertex, (Operations{0, 0, 3}));
  // The ends take 2 · (6, 6, 3). Then come the width, 9 nodes, and 4 additions and a division for
  // each of two attributes.
  EXPECT_EQ(quadratic.per_row, (Operations{12 + 1 + 9 + 2 * 4, 12 + 18, 6 + 1 + 6 + 2}));
  EXPECT_EQ(quadratic.per_pixel, (Operations{1 + 4, 1 + 4, 0}));
  const OperationCounts cubic = find_method("polynomial-cubic")->operations();
  // There are 12 nodes. d_1 to d_3 take 1, 2 and 4 additions; the coefficients take 3 additions and
  // 4 divisions.
  EXPECT_EQ(cubic.per_row, (Operations{12 + 1 + 12 + 2 * 10, 12 + 24, 6 + 1 + 8 + 2 * 4}));
  EXPECT_EQ(cubic.per_pixel, (Operations{1 + 6, 1 + 6, 0}));
}

}  // namespace
}  // namespace rastercheck::rasterizer::polynomial_test
