// The law catches a point that misses its pixel or covers another one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::small_points_cover_their_pixel_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-point-at-a-centre-covers-its-pixel";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

// The points are moved to the centres (3.5, 3.5) and (5.5, 3.5).
TEST(SmallPoints, CoverTheirPixel) {
  const Check check = checked(two_points());
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 2U);
}

TEST(SmallPoints, MissTheirPixel) {
  const Check check =
      checked(two_points(), [](const Case&, Fragments& drawn) { drop(drawn, 1, 5, 3); });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations.front().place.x, 5U);
  EXPECT_EQ(check.violations.front().place.y, 3U);
}

TEST(SmallPoints, CoverAnother) {
  const Check check =
      checked(two_points(), [](const Case&, Fragments& drawn) { add(drawn, 1, 4, 3); });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::extra);
}

}  // namespace
}  // namespace rastercheck::properties::small_points_cover_their_pixel_test
