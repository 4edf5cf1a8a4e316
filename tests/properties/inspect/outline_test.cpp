// Outlines in a window of 8 × 8 pixels, whose guard band reaches from -8 to 16.

#include "properties/inspect/outline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::outline_test {
namespace {

using records::WindowPoint;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<WindowPoint> outline(const std::array<cases::ClipVertex, 3>& positions,
                                 cases::Rules rules = cases::Rules::vulkan) {
  cases::Case c = square();
  c.rules = rules;
  c.positions = {positions.begin(), positions.end()};
  const oracle::SceneTruth scene(c, cases::contract_of(c));
  return outline_of(scene, 0);
}

TEST(Outline, HasTheVerticesInTheirOrder) {
  EXPECT_THAT(outline({{{-1, -1, 0, 1}, {2, -2, 0, 2}, {-1, 0.5F, 0, 1}}}),
              ElementsAre(WindowPoint{0, 0}, WindowPoint{8, 0}, WindowPoint{0, 6}));
}

// Kills: a window upside down under D3D.
TEST(Outline, FollowsTheRules) {
  EXPECT_THAT(outline({{{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 0.5F, 0, 1}}}, cases::Rules::d3d),
              ElementsAre(WindowPoint{0, 8}, WindowPoint{8, 8}, WindowPoint{0, 2}));
}

/// x and y of all corners in their order, beginning with the least corner.
std::vector<double> coordinates(std::vector<WindowPoint> corners) {
  const auto first = std::min_element(corners.begin(), corners.end(),
                                      [](const WindowPoint& a, const WindowPoint& b) {
                                        return std::pair(a.x, a.y) < std::pair(b.x, b.y);
                                      });
  std::rotate(corners.begin(), first, corners.end());
  std::vector<double> all;
  for (const WindowPoint& corner : corners) {
    all.push_back(corner.x);
    all.push_back(corner.y);
  }
  return all;
}

// Two vertices appear at (4, 4) and (8, 4). The third is behind the eye and projects to (0, 0), so
// the edges run along y = x and y = x/2 and leave the guard band at x = 16. Kills: a corner behind
// the eye drawn at its projection; corners beyond the guard band.
TEST(Outline, IsCutAtTheGuard) {
  using testing::DoubleEq;
  EXPECT_THAT(coordinates(outline({{{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, -1}}})),
              ElementsAre(DoubleEq(4), DoubleEq(4), DoubleEq(8), DoubleEq(4), DoubleEq(16),
                          DoubleEq(8), DoubleEq(16), DoubleEq(16)));
}

// The third vertex is behind the eye and projects to y = -2^-60 in NDC; the two others are at
// 2^-60. The part in front of the eye is everything with greater y, including two corners of the
// guard band. Kills: an outline that is lost if the eye lies almost in the triangle's plane.
TEST(Outline, IsThereWhereTheEyeIsAlmostInThePlane) {
  EXPECT_THAT(outline({{{1, 0x1p-60F, 0, 1}, {-1, 0x1p-60F, 0, 1}, {0, 1, 0, -0x1p60F}}}),
              testing::IsSupersetOf({WindowPoint{16, 16}, WindowPoint{-8, 16}}));
}

TEST(Outline, OfMoreThanTheScreenIsTheGuard) {
  const auto points = outline({{{-1e30F, -1e30F, 0, 1}, {1e30F, -1e30F, 0, 1}, {0, 1e30F, 0, 1}}});
  EXPECT_THAT(points, testing::UnorderedElementsAre(WindowPoint{-8, -8}, WindowPoint{16, -8},
                                                    WindowPoint{16, 16}, WindowPoint{-8, 16}));
}

TEST(Outline, IsNotThereBehindTheEye) {
  EXPECT_THAT(outline({{{-1, -1, 0, -1}, {1, -1, 0, -1}, {0, 1, 0, -1}}}), IsEmpty());
  EXPECT_THAT(outline({{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}), IsEmpty());
}

}  // namespace
}  // namespace rastercheck::properties::outline_test
