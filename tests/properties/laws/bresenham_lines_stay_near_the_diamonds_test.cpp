// The law accepts what the APIs permit, and catches pixels that are too far away, too many or too
// few, two of a column, and a joint that is drawn twice.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::bresenham_lines_stay_near_the_diamonds_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "bresenham-lines-stay-near-the-diamonds";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

/// A line from (3.5, 4.5) to (8.5, 4.5): the pixels x = 3 to 7 of row 4.
Case one_line() {
  Case c = bresenham_line();
  c.framebuffer = {16, 16, 1};
  c.viewport.width = 16;
  c.viewport.height = 16;
  c.positions = {{-0.5625F, -0.4375F, 0.25F, 1}, {0.0625F, -0.4375F, 0.25F, 1}};
  return c;
}

/// The same and another line from its end to (12.5, 4.5).
Case two_lines() {
  Case c = one_line();
  c.positions.push_back({0.5625F, -0.4375F, 0.25F, 1});
  c.attribute_values = {1, 7, 12};
  c.triangles = {{0, 1, 1}, {1, 2, 2}};
  return c;
}

TEST(NearDiamonds, AcceptWhatIsPermitted) {
  EXPECT_EQ(checked(one_line()).violation_count, 0U);
  EXPECT_THAT(checked(two_lines()).labels, testing::Contains("joint"));
  EXPECT_EQ(checked(two_lines()).violation_count, 0U);
  // One pixel fewer; one in the next row.
  EXPECT_EQ(checked(one_line(),
                    [](const Case&, Fragments& drawn) {
                      drop(drawn, 0, 7, 4);
                      drop(drawn, 0, 5, 4);
                      add(drawn, 0, 5, 5);
                    })
                .violation_count,
            0U);
}

TEST(NearDiamonds, CatchAPixelFarAway) {
  const Check check = checked(one_line(), [](const Case&, Fragments& drawn) {
    drop(drawn, 0, 5, 4);
    add(drawn, 0, 5, 6);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().place.y, 6U);
}

TEST(NearDiamonds, CatchTheCount) {
  const Check check = checked(one_line(), [](const Case&, Fragments& drawn) {
    drop(drawn, 0, 3, 4);
    drop(drawn, 0, 5, 4);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().exact, "3 pixels drawn, the diamond-exit rule has 5");
}

TEST(NearDiamonds, CatchTwoInAColumn) {
  const Check check =
      checked(one_line(), [](const Case&, Fragments& drawn) { add(drawn, 0, 5, 5); });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().exact, "forbidden: pixel (5, 4) is in the same column");
}

TEST(NearDiamonds, CatchAJointDrawnTwice) {
  const Check check =
      checked(two_lines(), [](const Case&, Fragments& drawn) { add(drawn, 0, 8, 4); });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().place.triangle, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::bresenham_lines_stay_near_the_diamonds_test
