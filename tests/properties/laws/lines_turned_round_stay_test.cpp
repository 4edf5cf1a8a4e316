// The law catches a pixel that only one direction draws; at the ends of Bresenham's lines it does
// not look.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::lines_turned_round_stay_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-line-turned-round-stays";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

/// Loses a pixel if the line was turned round.
Damage losing(int x, int y) {
  return [x, y](const Case& c, Fragments& drawn) {
    if (c.triangles[0][0] == 1 && is_drawn(drawn, 0, x, y)) drop(drawn, 0, x, y);
  };
}

TEST(TurnedLines, Stay) {
  EXPECT_EQ(checked(level_line()).violation_count, 0U);
  EXPECT_EQ(checked(bresenham_line()).violation_count, 0U);
  EXPECT_THAT(checked(bresenham_line()).labels, testing::Contains("at an end"));
}

TEST(TurnedLines, LosesAPixel) {
  const Check area = checked(level_line(), losing(3, 1));
  ASSERT_EQ(area.violation_count, 1U);
  EXPECT_EQ(area.violations.front().fragment_class, FragmentClass::missing);
  const Check diamonds = checked(bresenham_line(), losing(4, 2));
  ASSERT_EQ(diamonds.violation_count, 1U);
  EXPECT_EQ(diamonds.violations.front().note, "drawn with the ends of each line exchanged");
  EXPECT_EQ(checked(bresenham_line(), losing(6, 2)).violation_count, 0U);
}

TEST(TurnedLines, HaveTheSameValues) {
  const Check check = checked(level_line(), [](const Case& c, Fragments& drawn) {
    if (c.triangles[0][0] == 1) value(drawn, 0, 3, 1, 0) = 4.5F;
  });
  EXPECT_EQ(check.violation_count, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::lines_turned_round_stay_test
