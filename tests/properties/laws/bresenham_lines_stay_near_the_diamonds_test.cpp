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

/// bresenham_line() and another one from its end (6.5, 2.5) to (7.5, 2.5).
Case two_lines() {
  Case c = bresenham_line();
  c.framebuffer.width = 16;
  c.viewport.width = 16;
  c.positions = {
      {-0.8125F, -0.375F, 0.25F, 1}, {-0.1875F, -0.375F, 0.25F, 1}, {0.4375F, -0.375F, 0.25F, 1}};
  c.attribute_values = {1, 7, 12};
  c.triangles = {{0, 1, 1}, {1, 2, 2}};
  return c;
}

TEST(NearDiamonds, AcceptWhatIsPermitted) {
  EXPECT_EQ(checked(bresenham_line()).violation_count, 0U);
  EXPECT_THAT(checked(two_lines()).labels, testing::Contains("joint"));
  EXPECT_EQ(checked(two_lines()).violation_count, 0U);
  // One pixel fewer; one in the next row.
  EXPECT_EQ(checked(bresenham_line(),
                    [](const Case&, Fragments& drawn) {
                      drop(drawn, 0, 5, 2);
                      drop(drawn, 0, 3, 2);
                      add(drawn, 0, 3, 3);
                    })
                .violation_count,
            0U);
}

TEST(NearDiamonds, CatchAPixelFarAway) {
  const Check check = checked(bresenham_line(), [](const Case&, Fragments& drawn) {
    drop(drawn, 0, 3, 2);
    add(drawn, 0, 3, 4);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().place.y, 4U);
}

TEST(NearDiamonds, CatchTheCount) {
  const Check check = checked(bresenham_line(), [](const Case&, Fragments& drawn) {
    drop(drawn, 0, 1, 2);
    drop(drawn, 0, 3, 2);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().exact, "3 pixels drawn, the diamond-exit rule has 5");
}

TEST(NearDiamonds, CatchTwoInAColumn) {
  const Check check =
      checked(bresenham_line(), [](const Case&, Fragments& drawn) { add(drawn, 0, 3, 3); });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().exact, "forbidden: pixel (3, 2) is in the same column");
}

TEST(NearDiamonds, CatchAJointDrawnTwice) {
  const Check check =
      checked(two_lines(), [](const Case&, Fragments& drawn) { add(drawn, 0, 6, 2); });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().place.triangle, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::bresenham_lines_stay_near_the_diamonds_test
