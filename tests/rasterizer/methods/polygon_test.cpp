#include "rasterizer/methods/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "rasterizer/methods/method.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::polygon_test {
namespace {

constexpr TargetSize kEight{8, 8, 1};

State with_one_attribute() {
  State state = small_state(8, 8);
  state.attributes = {{}};
  return state;
}

/// A polygon with these window corners, w = 1 and the attribute u.
std::vector<PolygonVertex> polygon_of(const State& state, const std::vector<glm::vec2>& corners) {
  std::vector<PolygonVertex> polygon;
  polygon.reserve(corners.size());
  for (const glm::vec2& c : corners) polygon.push_back({at(state, c.x, c.y), {c.x}, {}});
  return polygon;
}

std::optional<PolygonFault> fault_of(const State& state,
                                     const std::vector<PolygonVertex>& polygon) {
  Fragments fragments;
  const auto fault = draw_polygon("scanline-linear", state, polygon, kEight, fragments);
  EXPECT_EQ(fragments.size() == 0, fault.has_value());
  return fault;
}

std::optional<PolygonError> error_of(const State& state,
                                     const std::vector<PolygonVertex>& polygon) {
  const auto fault = fault_of(state, polygon);
  return fault ? std::optional(fault->error) : std::nullopt;
}

// Two samples lie on the polygon's left edge, two on its right edge.
TEST(Polygon, CoversWhatIsInsideWhicheverWayItTurns) {
  const State state = with_one_attribute();
  std::vector<PolygonVertex> polygon =
      polygon_of(state, {{2.25F, 0}, {5.75F, 0}, {7.75F, 4}, {4, 7.75F}, {0.25F, 4}});
  for (const bool reversed : {false, true}) {
    if (reversed) polygon = {polygon.rbegin(), polygon.rend()};
    Fragments fragments;
    ASSERT_FALSE(draw_polygon("rational-linear", state, polygon, kEight, fragments).has_value());
    EXPECT_EQ(picture(fragments, kEight), (Rows{"..####..", ".#####..", ".######.", "#######.",
                                                ".######.", "..####..", "...##...", "........"}));
    expect_values(fragments, [](double u, double) { return u; });
  }
}

// Kills: a triangle drawn differently from the polygon with the same three corners.
TEST(Polygon, OfThreeCornersIsTheTriangle) {
  const State state = with_one_attribute();
  SmallMesh mesh;
  mesh.positions = {at(state, 1, 1, 1), at(state, 7, 2, 3), at(state, 3, 7, -2)};
  mesh.attributes = {1, 2, 4};
  mesh.triangles = {{0, 1, 2}};
  std::vector<PolygonVertex> polygon;
  for (std::size_t i = 0; i < 3; ++i) {
    polygon.push_back({mesh.positions[i], {mesh.attributes[i]}, {}});
  }
  for (const Method& method : methods()) {
    if (method.draw_polygon == nullptr) continue;
    Fragments expected;
    ASSERT_FALSE(draw_fragments_by(method.name, state, mesh.mesh(), kEight, expected).error);
    ASSERT_GT(expected.size(), 0U);
    Fragments fragments;
    ASSERT_FALSE(draw_polygon(method.name, state, polygon, kEight, fragments).has_value());
    EXPECT_EQ(fragments.x, expected.x) << method.name;
    EXPECT_EQ(fragments.y, expected.y) << method.name;
    EXPECT_EQ(fragments.depth, expected.depth) << method.name;
    EXPECT_EQ(fragments.attributes, expected.attributes) << method.name;
  }
}

// By hand: a square in perspective, with w = 1 and the attribute 0 on the left, and w = 2 and the
// attribute 1 on the right. As in the square's triangles, r = u/(16 − u).
TEST(Polygon, OfAPlaneIsInPerspective) {
  const State state = with_one_attribute();
  std::vector<PolygonVertex> polygon{{at(state, 0, 0, 1), {0}, {}},
                                     {at(state, 8, 0, 2), {1}, {}},
                                     {at(state, 8, 8, 2), {1}, {}},
                                     {at(state, 0, 8, 1), {0}, {}}};
  Fragments fragments;
  ASSERT_FALSE(draw_polygon("rational-linear", state, polygon, kEight, fragments).has_value());
  ASSERT_EQ(fragments.size(), 64U);
  expect_values(fragments, [](double u, double) { return u / (16 - u); });
}

// A floor below the eye, from w = 4 before the eye to w = −1 behind it, with the attribute (4 −
// w)/5. Its far border is at v = 5, and w = 4/(v − 4).
TEST(Polygon, MayReachBehindTheEye) {
  const State state = with_one_attribute();
  const std::vector<PolygonVertex> polygon{{{-16, 1, 2, 4}, {0}, {}},
                                           {{16, 1, 2, 4}, {0}, {}},
                                           {{16, 1, -0.5F, -1}, {1}, {}},
                                           {{-16, 1, -0.5F, -1}, {1}, {}}};
  Fragments fragments;
  ASSERT_FALSE(draw_polygon("rational-linear", state, polygon, kEight, fragments).has_value());
  EXPECT_EQ(fragments.size(), 3U * 8);
  expect_values(fragments, [](double, double v) { return (4 - 4 / (v - 4)) / 5; });
}

TEST(Polygon, SaysWhichMethodIsNone) {
  const State state = with_one_attribute();
  const auto polygon = polygon_of(state, {{0, 0}, {8, 0}, {0, 8}});
  Fragments fragments;
  const auto unknown = draw_polygon("no-method", state, polygon, kEight, fragments);
  ASSERT_TRUE(unknown.has_value());
  EXPECT_EQ(unknown->error, PolygonError::draw);
  EXPECT_EQ(unknown->refused, Error::unknown_method);
  const auto other = draw_polygon("screen-linear", state, polygon, kEight, fragments);
  ASSERT_TRUE(other.has_value());
  EXPECT_EQ(other->error, PolygonError::no_polygons);
  const auto size = draw_polygon("rational-linear", state, polygon, {8, 8, 3}, fragments);
  ASSERT_TRUE(size.has_value());
  EXPECT_EQ(size->refused, Error::sample_count);
}

TEST(Polygon, RefusesACountOfCornersOrValuesThatIsNone) {
  const State state = with_one_attribute();
  EXPECT_EQ(error_of(state, {}), PolygonError::corner_count);
  EXPECT_EQ(error_of(state, polygon_of(state, {{0, 0}, {8, 8}})), PolygonError::corner_count);
  std::vector<glm::vec2> round;
  for (std::size_t i = 0; i <= kMaxPolygonCorners; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / (kMaxPolygonCorners + 1);
    round.emplace_back(4 + 4 * std::cos(angle), 4 + 4 * std::sin(angle));
  }
  EXPECT_EQ(error_of(state, polygon_of(state, round)), PolygonError::corner_count);
  round.pop_back();
  EXPECT_EQ(error_of(state, polygon_of(state, round)), std::nullopt);

  auto polygon = polygon_of(state, {{0, 0}, {8, 0}, {0, 8}});
  polygon[1].attributes = {};
  EXPECT_EQ(error_of(state, polygon), PolygonError::attribute_values);
  polygon = polygon_of(state, {{0, 0}, {8, 0}, {0, 8}});
  polygon[2].clip_distances = {1};
  const auto fault = fault_of(state, polygon);
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->error, PolygonError::clip_distance_values);
  EXPECT_EQ(fault->index, 2U);
}

TEST(Polygon, RefusesWhatIsNoNumber) {
  const State state = with_one_attribute();
  for (const float bad :
       {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    auto polygon = polygon_of(state, {{0, 0}, {8, 0}, {0, 8}});
    polygon[1].position.w = bad;
    EXPECT_EQ(error_of(state, polygon), PolygonError::not_finite);
    polygon = polygon_of(state, {{0, 0}, {8, 0}, {0, 8}});
    polygon[1].attributes[0] = bad;
    EXPECT_EQ(error_of(state, polygon), PolygonError::not_finite);
  }
}

TEST(Polygon, RefusesCentresWhichMayHaveNoValue) {
  State state = with_one_attribute();
  const auto polygon = polygon_of(state, {{0, 0}, {8, 0}, {0, 8}});
  for (const Location location : {Location::center, Location::centroid}) {
    state.attributes[0] = {Interpolation::smooth, location};
    EXPECT_EQ(error_of(state, polygon), PolygonError::location);
    state.attributes[0].interpolation = Interpolation::flat;
    EXPECT_EQ(error_of(state, polygon), std::nullopt);
  }
}

// Kills: convexity judged by the turns of neighbouring edges alone, which a star passes; a refusal
// of corners in line.
TEST(Polygon, RefusesWhatIsNotConvex) {
  const State state = with_one_attribute();
  EXPECT_EQ(error_of(state, polygon_of(state, {{0, 0}, {8, 0}, {2, 2}, {0, 8}})),
            PolygonError::not_convex);
  EXPECT_EQ(error_of(state, polygon_of(state, {{0, 0}, {8, 8}, {8, 0}, {0, 8}})),
            PolygonError::not_convex);
  // Every second corner of a pentagon: the polygon turns to the same side everywhere, and goes
  // around twice.
  EXPECT_EQ(error_of(state, polygon_of(state, {{4, 0}, {6, 7}, {0, 3}, {8, 3}, {2, 7}})),
            PolygonError::not_convex);
  EXPECT_EQ(error_of(state, polygon_of(state, {{0, 0}, {4, 0}, {8, 0}, {8, 8}, {0, 8}})),
            std::nullopt);
  EXPECT_EQ(error_of(state, polygon_of(state, {{0, 0}, {8, 0}, {4, 0}, {8, 8}, {0, 8}})),
            PolygonError::not_convex);
}

TEST(Polygon, RefusesWhatHasNoArea) {
  const State state = with_one_attribute();
  EXPECT_EQ(error_of(state, polygon_of(state, {{0, 0}, {2, 2}, {4, 4}, {8, 8}})),
            PolygonError::degenerate);
  EXPECT_EQ(error_of(state, polygon_of(state, {{1, 2}, {1, 2}, {1, 2}})), PolygonError::degenerate);
}

TEST(Polygon, HasASentenceForEveryError) {
  for (const PolygonError error :
       {PolygonError::draw, PolygonError::no_polygons, PolygonError::corner_count,
        PolygonError::attribute_values, PolygonError::clip_distance_values,
        PolygonError::not_finite, PolygonError::location, PolygonError::degenerate,
        PolygonError::not_convex}) {
    EXPECT_FALSE(to_string(error).empty());
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::polygon_test
