// The law catches values one ulp beyond the bound, zeros of the wrong sign, and values that are not
// numbers; it ignores coverage.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::values_stay_within_the_bound_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "values-stay-within-the-bound";

// For an attribute that is one everywhere, one ulp of the value is one scale ULP.
TEST(ValuesStayWithinTheBound, FindsOneUlp) {
  const Check check = check_of(kLaw, square(), [](const Case&, Fragments& drawn) {
    value(drawn, 1, 6, 5, 1) = std::nextafter(1.0F, 2.0F);
  });
  expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::smooth, 1, 6, 5);
  EXPECT_EQ(only(check).attribute, 1U);
  EXPECT_EQ(only(check).exact, "1");
  ASSERT_TRUE(only(check).error.has_value());
  EXPECT_TRUE(records::contains(*only(check).error, 1));
}

TEST(ValuesStayWithinTheBound, FindsWhatIsNoNumber) {
  const Check check = check_of(kLaw, square(), [](const Case&, Fragments& drawn) {
    drawn.depth[find(drawn, 0, 1, 1)] = std::numeric_limits<float>::quiet_NaN();
    value(drawn, 0, 2, 1, 0) = -std::numeric_limits<float>::infinity();
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::not_a_number, AttributeKind::depth, 0, 1, 1);
  EXPECT_EQ(check.violations[0].attribute, std::nullopt);
  EXPECT_EQ(check.violations[0].actual, "nan");
  EXPECT_EQ(check.violations[0].exact, "1/4");
  expect_at(check.violations[1], FragmentClass::infinite, AttributeKind::smooth, 0, 2, 1);
  EXPECT_EQ(check.violations[1].actual, "-inf");
}

TEST(ValuesStayWithinTheBound, FindsTheOtherZero) {
  const Check check = check_of(
      kLaw, square(), [](const Case&, Fragments& drawn) { value(drawn, 0, 1, 1, 2) = -0.0F; });
  expect_at(only(check), FragmentClass::wrong_sign_of_zero, AttributeKind::smooth, 0, 1, 1);
  EXPECT_EQ(only(check).attribute, 2U);
}

TEST(ValuesStayWithinTheBound, LeavesCoverageAlone) {
  const Check check = check_of(kLaw, square(), [](const Case&, Fragments& drawn) {
    drop(drawn, 0, 1, 1);
    add(drawn, 0, 6, 6);
  });
  EXPECT_EQ(check.violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::values_stay_within_the_bound_test
