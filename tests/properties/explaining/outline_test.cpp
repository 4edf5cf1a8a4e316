// Outlines in a window of 8 × 8 pixels, whose guard is -8 to 16.

#include "properties/explaining/outline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties {
namespace {

using records::WindowPoint;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<WindowPoint> outline(const std::array<cases::ClipVertex, 3>& positions,
                                 cases::Rules rules = cases::Rules::vulkan) {
  cases::Case c = square();
  c.rules = rules;
  c.positions = {positions.begin(), positions.end()};
  return outline_of(c, {0, 1, 2});
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

// Two vertices at (4, 4) and (8, 4); the third is behind the eye, (0, 0, -1) as (X, Y, w). From the
// first, (4, 4, 1), the edge to it is (4 - 4t, 4 - 4t, 1 - 2t), which grows without end before
// w = 0 and leaves the guard where 4 - 4t = 16 (1 - 2t): at (16, 16). From the second, (8, 4, 1),
// it is (8 - 8t, 4 - 4t, 1 - 2t), which leaves where 8 - 8t = 16 (1 - 2t): at (16, 8).
// Kills: a corner that is taken to where it is seen behind the eye; corners beyond the guard.
TEST(Outline, IsCutAtTheGuard) {
  EXPECT_THAT(
      outline({{{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, -1}}}),
      ElementsAre(WindowPoint{4, 4}, WindowPoint{8, 4}, WindowPoint{16, 8}, WindowPoint{16, 16}));
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
}  // namespace rastercheck::properties
