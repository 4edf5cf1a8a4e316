// The law catches values of a cut line that are not the whole line's.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::clipped_lines_keep_their_values_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-clipped-line-keeps-its-values";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

/// Cut in the middle, at x = 4.
Case cut_line() {
  Case c = level_line();
  c.clip_distance_count = 1;
  c.clip_distances = {1, -1};
  return c;
}

TEST(ClippedLines, KeepTheirValues) {
  const Check check = checked(cut_line());
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Contains("cut"));
  EXPECT_FALSE(checked(level_line()).is_applicable);
}

TEST(ClippedLines, HaveTheValuesOfNewEnds) {
  const Check check = checked(cut_line(), [](const Case& c, Fragments& drawn) {
    if (c.clip_distance_count > 0) value(drawn, 0, 2, 1, 0) = 4;
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
}

TEST(ClippedLines, MayLoseSamples) {
  const Check check = checked(cut_line(), [](const Case& c, Fragments& drawn) {
    if (c.clip_distance_count > 0) drop(drawn, 0, 2, 1);
  });
  EXPECT_EQ(check.violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::clipped_lines_keep_their_values_test
