// The law catches missing and extra samples and other values than the vertex's.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::points_obey_the_contract_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "points-obey-the-contract";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

TEST(Points, ObeyTheContract) {
  EXPECT_EQ(checked(two_points()).violation_count, 0U);
  EXPECT_EQ(checked(two_points()).judgement.counts.required, 8U);
  EXPECT_FALSE(checked(level_line()).is_applicable);
}

TEST(Points, AreJudgedInCoverageAndValues) {
  const Check missing =
      checked(two_points(), [](const Case&, Fragments& drawn) { drop(drawn, 1, 4, 2); });
  ASSERT_EQ(missing.violation_count, 1U);
  EXPECT_EQ(missing.violations.front().fragment_class, FragmentClass::missing);
  const Check wrong =
      checked(two_points(), [](const Case&, Fragments& drawn) { value(drawn, 1, 4, 2, 0) = 1; });
  EXPECT_EQ(wrong.violations.front().fragment_class, FragmentClass::beyond_bound);
}

}  // namespace
}  // namespace rastercheck::properties::points_obey_the_contract_test
