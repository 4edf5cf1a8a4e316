// `cpu` keeps the law on integers; values that round to another integer break it, and values that
// only truncate to another one are labelled. The law does not apply beyond what the contract
// promises.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::integers_survive_rounding_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kLaw = "integers-survive-rounding";

/// A bound like that of a driver: a few ULP.
cases::Contract contract_with(cases::ValueBound smooth) {
  cases::Contract contract = DamagedBackend().contract(square());
  contract.bounds.smooth = smooth;
  return contract;
}

TEST(IntegersSurviveRounding, OnCpuAndMeetWhatTheyAreAbout) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_GT(found.applicable, 100);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf({"zero", "positive integer", "negative integer", "clipped",
                                     "several samples", "snapped", "w <= 0"}));
}

// Attribute 1 is 1 everywhere, attribute 2 is 0.
TEST(IntegersSurviveRounding, FindsTheIntegersBesideThem) {
  const Check check = check_of(kLaw, square(), [](const Case&, Fragments& drawn) {
    value(drawn, 0, 2, 3, 1) = 0.25F;
    value(drawn, 1, 6, 6, 2) = std::numeric_limits<float>::quiet_NaN();
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::beyond_bound, AttributeKind::smooth, 0, 2, 3);
  EXPECT_EQ(check.violations[0].attribute, 1U);
  EXPECT_EQ(check.violations[0].exact, "1");
  EXPECT_THAT(check.violations[0].note,
              HasSubstr("all three vertices have 1; the nearest integer is 0, truncation gives 0"));
  expect_at(check.violations[1], FragmentClass::not_a_number, AttributeKind::smooth, 1, 6, 6);
}

// 0.9999 arrives where 1 was meant: a cast gives 0, rounding gives 1.
TEST(IntegersSurviveRounding, LabelsWhatOnlyTruncationLoses) {
  Case c = square();
  for (std::size_t v = 0; v < 4; ++v) c.attribute_values[3 * v + 2] = -1;
  const std::string below = "truncates to the integer below";
  const std::string above = "truncates to the integer above";
  const auto labels = [&](std::size_t attribute, float drawn_value) {
    DamagedBackend backend([=](const Case&, Fragments& drawn) {
      for (std::size_t i = 0; i < drawn.size(); ++i)
        drawn.attributes[3 * i + attribute] = drawn_value;
    });
    const Check check = check_of(kLaw, c, backend);
    EXPECT_EQ(check.violation_count, 0U);
    return check.labels;
  };
  EXPECT_THAT(labels(1, 1), Not(Contains(below)));
  EXPECT_THAT(labels(1, 1.0001F), Not(Contains(below)));
  EXPECT_THAT(labels(1, 0.9999F), Contains(below));
  EXPECT_THAT(labels(2, -0.9999F), Contains(above));
  EXPECT_THAT(labels(2, -1), Not(Contains(above)));
}

// A bound of 2^22 ULP of 1 is 1/2: the nearest integer is open.
TEST(IntegersSurviveRounding, JudgesWhatTheContractImpliesOnly) {
  DamagedBackend backend([](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 1) = 0.25F; });
  const auto violations = [&](cases::ValueBound smooth) {
    backend.promised = contract_with(smooth);
    return check_of(kLaw, square(), backend).violation_count;
  };
  EXPECT_EQ(violations({0.5F, 0}), 1U);
  EXPECT_EQ(violations({0x1p21F, 0}), 1U);
  EXPECT_EQ(violations({0x1p22F, 0}), 0U);
  EXPECT_EQ(violations({0.5F, 0, 0, 0, 0.25F}), 1U);
  EXPECT_EQ(violations({0.5F, 0, 0, 0, 0.5F}), 0U);
}

TEST(IntegersSurviveRounding, SaysNothingOfOtherAttributes) {
  Case c = square();
  c.attributes.resize(1);
  c.attribute_values = {0, 8, 0, 8};
  EXPECT_FALSE(check_of(kLaw, c, {}).is_applicable);
  c.attribute_values = {1.5F, 1.5F, 1.5F, 1.5F};
  EXPECT_FALSE(check_of(kLaw, c, {}).is_applicable);
  c.attribute_values = {1, 1, 1, 1};
  EXPECT_TRUE(check_of(kLaw, c, {}).is_applicable);
  c.attributes[0].interpolation = cases::Interpolation::flat;
  EXPECT_FALSE(check_of(kLaw, c, {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::integers_survive_rounding_test
