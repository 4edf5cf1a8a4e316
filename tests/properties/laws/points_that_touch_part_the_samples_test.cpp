// The law catches samples that two points that touch share, or leave out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::points_that_touch_part_the_samples_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "points-that-touch-part-the-samples";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

TEST(TouchingPoints, PartTheSamples) {
  const Check check = checked(two_points());
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 8U);
}

TEST(TouchingPoints, ShareASample) {
  const Check check =
      checked(two_points(), [](const Case&, Fragments& drawn) { add(drawn, 1, 3, 2); });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::extra);
  EXPECT_EQ(check.violations.front().note, "point 0 has it as well");
}

TEST(TouchingPoints, LeaveOutASample) {
  const Check check =
      checked(two_points(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 3, 2); });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations.front().place.x, 3U);
  EXPECT_EQ(check.violations.front().place.y, 2U);
}

TEST(TouchingPoints, MustTouch) {
  Case apart = two_points();
  apart.point_size = 1;
  EXPECT_FALSE(checked(apart).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::points_that_touch_part_the_samples_test
