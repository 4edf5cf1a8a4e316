// The law catches missing, extra and wrong samples of lines, and leaves others alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::lines_obey_the_contract_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "lines-obey-the-contract";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

TEST(Lines, ObeyTheContract) {
  EXPECT_EQ(checked(level_line()).violation_count, 0U);
  EXPECT_EQ(checked(level_line()).judgement.counts.required, 12U);
  EXPECT_FALSE(checked(two_points()).is_applicable);
  EXPECT_FALSE(checked(square()).is_applicable);
}

TEST(Lines, AreJudgedInCoverageAndValues) {
  const Check missing =
      checked(level_line(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 3, 1); });
  ASSERT_EQ(missing.violation_count, 1U);
  EXPECT_EQ(missing.violations.front().fragment_class, FragmentClass::missing);
  const Check extra =
      checked(level_line(), [](const Case&, Fragments& drawn) { add(drawn, 0, 7, 1); });
  EXPECT_EQ(extra.violations.front().fragment_class, FragmentClass::extra);
  const Check wrong = checked(
      level_line(), [](const Case&, Fragments& drawn) { value(drawn, 0, 3, 1, 0) = 3.25F; });
  EXPECT_EQ(wrong.violations.front().fragment_class, FragmentClass::beyond_bound);
}

}  // namespace
}  // namespace rastercheck::properties::lines_obey_the_contract_test
