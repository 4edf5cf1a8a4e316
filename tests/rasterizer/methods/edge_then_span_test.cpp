// edge-then-span and edge-then-span-plane, checked against values computed by hand.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string_view>

#include "tests/rasterizer/methods/method_draw.h"

namespace rastercheck::rasterizer::edge_then_span_test {
namespace {

/// The number of edges that bound a row.
constexpr std::size_t kEdges = 2;

constexpr TargetSize kEight{8, 8, 1};
constexpr std::string_view kNames[] = {"edge-then-span", "edge-then-span-plane"};

State with_one_attribute() {
  State state = small_state(8, 8);
  state.attributes = {{}};
  return state;
}

/// A triangle at the window positions (0, 0), (8, 0), (0, 8) with these w and values.
SmallMesh corner(const State& state, const std::vector<float>& w, const std::vector<float>& r) {
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, w[0]), at(state, 8, 0, w[1]), at(state, 0, 8, w[2])};
  mesh.attributes = r;
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

// Along spans q is 1 and 1/2 at the ends, so s = t/2 / (1 − t/2) = u/(16 − u).
TEST(EdgeThenSpan, AlongARowIsTheSharesFormula) {
  const State state = with_one_attribute();
  for (const std::string_view name : kNames) {
    expect_values(drawn_by(name, state, corner(state, {1, 2, 1}, {0, 1, 0}), kEight),
                  [](double u, double) { return u / (16 - u); });
  }
}

// Along edges q is 1 and 1/4 at the ends, so s = t/4 / (1 − 3 t/4) = v/(32 − 3 v); both ends of a
// row have this value.
TEST(EdgeThenSpan, AlongEdgesIsTheSharesFormula) {
  const State state = with_one_attribute();
  for (const std::string_view name : kNames) {
    expect_values(drawn_by(name, state, corner(state, {1, 1, 4}, {0, 0, 1}), kEight),
                  [](double, double v) { return v / (32 - 3 * v); });
  }
}

// Kills: q interpolated along edges by s, or not at all. With w = 1, 2, 4: 1/w = 1 − u/16 − 3 v/32.
TEST(EdgeThenSpan, AlongBothCarriesQAcross) {
  const State state = with_one_attribute();
  for (const std::string_view name : kNames) {
    expect_values(drawn_by(name, state, corner(state, {1, 2, 4}, {0, 2, 0}), kEight),
                  [](double u, double v) { return u / 8 / (1 - u / 16 - 3 * v / 32); });
  }
}

TEST(EdgeThenSpan, ConstantsComeOutExactlyOfShares) {
  const State state = with_one_attribute();
  const Fragments fragments = drawn_by(
      "edge-then-span", state, corner(state, {0.7F, 1.9F, 3.1F}, {0.1F, 0.1F, 0.1F}), kEight);
  ASSERT_GT(fragments.size(), 20U);
  EXPECT_EQ(fragments.attributes, std::vector<float>(fragments.size(), 0.1F));
}

// Kills: shares beyond 1, or NaN, where q at one end is negligible beside q at the other.
TEST(EdgeThenSpan, SharesStayBetweenTheEnds) {
  const State state = with_one_attribute();
  const Fragments fragments = drawn_by(
      "edge-then-span", state, corner(state, {0x1p-120F, 0x1p120F, 1}, {1, 2, 1.5F}), kEight);
  ASSERT_GT(fragments.size(), 20U);
  for (const float value : fragments.attributes) {
    EXPECT_GE(value, 1);
    EXPECT_LE(value, 2);
  }
}

// A vertex behind the eye has a window position too, here (0, 16), below the vertices with w = 1 at
// (0, 8) and (8, 8). Everything above v = 8 is drawn. 1/w = 3 − v/4, r/w = (8 − v)/8.
TEST(EdgeThenSpan, PlanesHoldBehindTheEye) {
  const State state = with_one_attribute();
  SmallMesh mesh = corner(state, {1, 1, 1}, {0, 0, 1});
  mesh.positions = {at(state, 0, 8, 1), at(state, 8, 8, 1), at(state, 0, 16, -1)};
  const Fragments fragments = drawn_by("edge-then-span-plane", state, mesh, kEight);
  ASSERT_EQ(fragments.size(), 64U);
  expect_values(fragments, [](double, double v) { return (8 - v) / (24 - 2 * v); });
}

// Kills: NaN where the window positions are so nearly in line that rounding loses the difference.
// Between the first and the third vertex, at (1, 0) and (1, 2) with w = 1, r is v/2. The second
// vertex lies behind the eye, 2^-69 beside that line.
TEST(EdgeThenSpan, PlanesHoldWhereTheDeterminantIsRoundedAway) {
  State state = small_state(2, 2);
  state.attributes = {{}};
  SmallMesh mesh;
  mesh.positions = {{0, -1, 0, 1}, {0x1p-69F, 0, 0, -1}, {0, 1, 0, 1}};
  mesh.attributes = {0, 0, 1};
  mesh.triangles = {{0, 1, 2}};
  const Fragments fragments = drawn_by("edge-then-span-plane", state, mesh, {2, 2, 1});
  ASSERT_EQ(fragments.size(), 2U);
  EXPECT_FLOAT_EQ(value_at(fragments, 1, 0), 0.25F);
}

TEST(EdgeThenSpan, PlanesPromiseNothingOfAVertexWithoutAPlace) {
  const State state = with_one_attribute();
  SmallMesh mesh = corner(state, {1, 2, 4}, {0, 1, 0});
  const Method& method = *find_method("edge-then-span-plane");
  EXPECT_LT(method.promise(state, mesh.mesh(), kEight).smooth.per_condition, 1);
  mesh.positions[1].w = 0;
  EXPECT_GE(method.promise(state, mesh.mesh(), kEight).smooth.per_condition, 0x1p24);
}

// By hand: a share with its q takes 4 additions, 2 products and 2 divisions; a parameter takes a
// difference, a product and a sum.
TEST(EdgeThenSpan, OperationsAreThoseOfTheSlides) {
  const OperationCounts shares = find_method("edge-then-span")->operations();
  EXPECT_EQ(shares.per_polygon, (Operations{0, 0, 0}));
  EXPECT_EQ(shares.per_vertex, (Operations{0, 0, 1}));
  EXPECT_EQ(shares.per_row, (Operations{kEdges * 8, kEdges * 4, kEdges * 2}));
  EXPECT_EQ(shares.per_pixel, (Operations{8, 4, 2}));
  // The adjugate's rows take 3 · 3 additions and 3 · 2 products, the determinant 2 additions, and
  // each of 9 coefficients 2 additions, 3 products and a division. A pixel takes 3 planes and 2
  // divisions.
  const OperationCounts planes = find_method("edge-then-span-plane")->operations();
  EXPECT_EQ(planes.per_polygon, (Operations{9 + 2 + 18, 6 + 27, 9}));
  EXPECT_EQ(planes.per_vertex, (Operations{0, 2, 3}));
  EXPECT_EQ(planes.per_pixel, (Operations{6, 6, 2}));
}

}  // namespace
}  // namespace rastercheck::rasterizer::edge_then_span_test
