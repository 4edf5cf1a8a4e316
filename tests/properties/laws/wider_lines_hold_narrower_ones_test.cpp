// The law catches a sample that the wider line lost.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::wider_lines_hold_narrower_ones_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "a-wider-line-holds-the-narrower-one";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

TEST(WiderLines, HoldNarrowerOnes) {
  const Check check = checked(level_line());
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 12U);
  EXPECT_FALSE(checked(bresenham_line()).is_applicable);
}

TEST(WiderLines, LoseASample) {
  const Check check = checked(level_line(), [](const Case& c, Fragments& drawn) {
    if (c.line_width > 2) drop(drawn, 0, 3, 1);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().exact, "required: the narrower line has it");
}

}  // namespace
}  // namespace rastercheck::properties::wider_lines_hold_narrower_ones_test
