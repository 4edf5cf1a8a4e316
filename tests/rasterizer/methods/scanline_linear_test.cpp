// scanline-linear checked by hand, and what Heckbert & Moreton 1991, §2.1, say of it: it is
// rotation invariant on triangles, but on polygons with more sides only if parameters are
// screen-affine.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "rasterizer/methods/method.h"
#include "rasterizer/methods/polygon.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer::scanline_linear_test {
namespace {

/// The number of edges that bound a row.
constexpr std::size_t kEdges = 2;

constexpr std::string_view kName = "scanline-linear";

State with_one_attribute(int size) {
  State state = small_state(size, size);
  state.attributes = {{}};
  return state;
}

/// A corner in window coordinates, with w = 1, and its value.
struct Corner {
  float u = 0;
  float v = 0;
  float r = 0;
};

std::vector<PolygonVertex> polygon_of(const State& state, const std::vector<Corner>& corners) {
  std::vector<PolygonVertex> polygon;
  polygon.reserve(corners.size());
  for (const Corner& c : corners) polygon.push_back({at(state, c.u, c.v), {c.r}, {}});
  return polygon;
}

/// The values of a polygon at each pixel.
std::map<std::pair<int, int>, float> values_of(const State& state, const TargetSize& size,
                                               const std::vector<Corner>& corners) {
  Fragments fragments;
  EXPECT_FALSE(draw_polygon(kName, state, polygon_of(state, corners), size, fragments).has_value());
  std::map<std::pair<int, int>, float> values;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    values[{fragments.x[i], fragments.y[i]}] = fragments.attributes[i];
  }
  return values;
}

/// The corners after the camera turns by a quarter about the middle of a square window of `size`
/// pixels S: (u, v) goes to (S − v, u).
std::vector<Corner> turned(int size, std::vector<Corner> corners) {
  for (Corner& c : corners) c = {static_cast<float>(size) - c.v, c.u, c.r};
  return corners;
}

/// The greatest change of a value when the camera turns.
double change_when_turned(int size, const std::vector<Corner>& corners) {
  const State state = with_one_attribute(size);
  const auto before = values_of(state, {size, size, 1}, corners);
  const auto after = values_of(state, {size, size, 1}, turned(size, corners));
  double greatest = 0;
  std::size_t compared = 0;
  for (const auto& [pixel, value] : before) {
    const auto found = after.find({size - 1 - pixel.second, pixel.first});
    if (found == after.end()) continue;  // on an edge that the fill rule gives to the other side
    ++compared;
    greatest = std::max(greatest, std::abs(double{value} - double{found->second}));
  }
  EXPECT_GE(2 * compared, before.size());
  return greatest;
}

// --- Triangles ----------------------------------------------------------------------------------

// w is 1 at u = 0 and 2 at u = 4, but the attribute is u/4 in the window.
TEST(ScanlineLinear, IsAffineInTheWindowOnATriangle) {
  State state = with_one_attribute(4);
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1), at(state, 4, 0, 2), at(state, 0, 4, 1)};
  mesh.attributes = {0, 1, 0};
  mesh.triangles = {{0, 1, 2}};
  Fragments fragments;
  ASSERT_FALSE(draw_fragments_by(kName, state, mesh.mesh(), {4, 4, 1}, fragments).error);
  expect_values(fragments, [](double u, double) { return u / 4; });
}

// Kills: perspective values at uncovered centres, where the other values are affine.
TEST(ScanlineLinear, ExtrapolatesWhatItClaims) {
  State state = with_one_attribute(4);
  state.attributes[0].location = Location::center;
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1), at(state, 4, 0, 2), at(state, 0, 4, 1)};
  mesh.attributes = {0, 1, 0};
  mesh.triangles = {{0, 1, 2}};
  Fragments fragments;
  ASSERT_FALSE(draw_fragments_by(kName, state, mesh.mesh(), {4, 4, 16}, fragments).error);
  expect_values(fragments, [](double u, double) { return u / 4; });
}

// By hand. Window positions (0, 0), (8, 0), (0, 8) with w = 1, 1, 3 and r = 0, 0, 8. The clip
// distances 1, 1, −1 cut halfway in clip space, at v = 6 with r = 4. So r = 2 v/3 between v = 0 and
// 6. The affine function would be v, and the perspective one 4 v/(12 − v).
TEST(ScanlineLinear, IsNeitherAffineNorInPerspectiveWhereClipped) {
  State state = with_one_attribute(8);
  state.clip_distance_count = 1;
  SmallMesh mesh;
  mesh.positions = {at(state, 0, 0, 1), at(state, 8, 0, 1), at(state, 0, 8, 3)};
  mesh.attributes = {0, 0, 8};
  mesh.clip_distances = {1, 1, -1};
  mesh.triangles = {{0, 1, 2}};
  Fragments fragments;
  ASSERT_FALSE(draw_fragments_by(kName, state, mesh.mesh(), {8, 8, 1}, fragments).error);
  expect_values(fragments, [](double, double v) { return 2 * v / 3; });
}

TEST(ScanlineLinear, ClaimsTheRangeOfTheVerticesOfADrawThatIsClipped) {
  State state = with_one_attribute(8);
  SmallMesh mesh = rectangle(state, {0, 0}, {8, 8});
  mesh.attributes = {0, 1, 2, 3};
  const Method& method = *find_method(kName);
  const Promise plain = method.promise(state, mesh.mesh(), {8, 8, 1});
  EXPECT_EQ(plain.claims, Claim::affine);
  EXPECT_EQ(plain.smooth.range_share, 0);
  mesh.positions[3].z = -1;
  const Promise clipped = method.promise(state, mesh.mesh(), {8, 8, 1});
  EXPECT_EQ(clipped.claims, Claim::perspective);
  EXPECT_EQ(clipped.smooth.range_share, 1);
  state.depth_clamp = true;
  EXPECT_EQ(method.promise(state, mesh.mesh(), {8, 8, 1}).claims, Claim::affine);
}

// By hand: two parameters, as for rational-linear but without 1/w, and divisions only in means.
TEST(ScanlineLinear, DividesNothingByW) {
  const OperationCounts counts = find_method(kName)->operations();
  EXPECT_EQ(counts.per_polygon, (Operations{0, 0, 0}));
  EXPECT_EQ(counts.per_vertex, (Operations{0, 0, 0}));
  EXPECT_EQ(counts.per_row, (Operations{kEdges * (3 + 2), kEdges * 4, kEdges * 2}));
  EXPECT_EQ(counts.per_pixel, (Operations{3 + 2, 4, 2}));
}

// --- Rotation -----------------------------------------------------------------------------------

/// Corners in order on a circle within a window of `size` pixels, in sixteenths of pixels, so that
/// float32 and double hold everything computed from the corners exactly, except the values. Values
/// are in [−1, 1).
std::vector<Corner> random_polygon(std::mt19937& random, int size, std::size_t count) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(random() >> 8) * 0x1p-24;
    angles.push_back(6.283185307179586 * (static_cast<double>(i) + 0.8 * part) /
                     static_cast<double>(count));
  }
  std::vector<Corner> corners;
  for (const double angle : angles) {
    const auto on_grid = [size](double x) {
      return static_cast<float>(std::round(16 * (0.5 + 0.48 * x) * size) / 16);
    };
    corners.push_back({on_grid(std::cos(angle)), on_grid(std::sin(angle)),
                       static_cast<float>(random() >> 7) * 0x1p-24F - 1});
  }
  return corners;
}

// By hand, as in the method's comment: the value at (4 1/2, 2 1/2) is 72/11 before the turn and 7
// after it.
TEST(ScanlineLinearRotation, ChangesAQuadByWhatIsCalculatedByHand) {
  const State state = with_one_attribute(8);
  const std::vector<Corner> quad{{0, 0, 0}, {8, 0, 8}, {4, 4, 8}, {0, 4, 0}};
  const auto before = values_of(state, {8, 8, 1}, quad);
  const auto after = values_of(state, {8, 8, 1}, turned(8, quad));
  EXPECT_EQ(before.at({4, 2}), static_cast<float>(72.0 / 11));
  EXPECT_EQ(after.at({5, 4}), 7);
}

// The error of two roundings to float32 of numbers below 1, each slightly more than half of 2^-24.
constexpr double kTwoRoundings = 2 * 0x1.001p-25;

// Values at four corners are affine only by chance. The greatest change must exceed the share 5/88
// of the range, as calculated by hand; the range here is 2.
TEST(ScanlineLinearRotation, ChangesEveryQuad) {
  std::mt19937 random(20260902);
  double greatest = 0;
  for (int i = 0; i < 200; ++i) {
    const double change = change_when_turned(64, random_polygon(random, 64, 4));
    EXPECT_GT(change, kTwoRoundings);
    greatest = std::max(greatest, change);
  }
  EXPECT_GT(greatest, 2 * 5.0 / 88);
}

// Kills: interpolation from the left end only; rows that begin at whole pixels.
TEST(ScanlineLinearRotation, ChangesNoTriangle) {
  std::mt19937 random(20260903);
  for (int i = 0; i < 200; ++i) {
    EXPECT_LE(change_when_turned(64, random_polygon(random, 64, 3)), kTwoRoundings);
  }
}

TEST(ScanlineLinearRotation, ChangesNoPolygonWhoseValuesAreAffineOnTheScreen) {
  std::mt19937 random(20260904);
  for (int i = 0; i < 200; ++i) {
    std::vector<Corner> corners = random_polygon(random, 64, 4 + static_cast<std::size_t>(i) % 4);
    const auto slope = [&random] {
      return static_cast<float>(random() >> 24) * 0x1p-15F - 0x1p-8F;
    };
    const float a = slope();
    const float b = slope();
    for (Corner& c : corners) c.r = a * c.u + b * c.v;  // |r| < 1/2, exact
    EXPECT_LE(change_when_turned(64, corners), kTwoRoundings);
  }
}

}  // namespace
}  // namespace rastercheck::rasterizer::scanline_linear_test
