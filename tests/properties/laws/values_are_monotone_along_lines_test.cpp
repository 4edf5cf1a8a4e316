// The law catches a value that turns back along a line, in either direction; it lets neighbouring
// floats alternate if the bound allows it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::values_are_monotone_along_lines_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "values-are-monotone-along-a-line";

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// Attribute 0 grows along rows, columns and both diagonals.
Case growing() {
  Case c = square();
  for (std::size_t i = 0; i < 4; ++i) c.attribute_values[i * 3] = static_cast<float>(i % 2 * 8);
  for (const std::size_t i : {std::size_t{2}, std::size_t{3}}) c.attribute_values[i * 3] += 24;
  return c;
}

TEST(Monotone, HoldsOfTheSquare) {
  const Check check = checked(growing(), {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::ElementsAre("attribute", "certain way", "depth"));
}

// Values that grow or fall, along lines in every direction.
TEST(Monotone, FindsAValueThatTurnsBack) {
  for (const float sign : {1.0F, -1.0F}) {
    Case c = growing();
    for (std::size_t i = 0; i < 4; ++i) c.attribute_values[i * 3] *= sign;
    for (const float off : {-20.0F, 20.0F}) {
      const Check check =
          checked(c, [off](const Case&, Fragments& drawn) { value(drawn, 0, 2, 2, 0) += off; });
      EXPECT_GT(check.violation_count, 0U);
      ASSERT_FALSE(check.violations.empty());
      EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
      EXPECT_EQ(check.violations.front().attribute, 0U);
      EXPECT_THAT(check.violations.front().note,
                  testing::HasSubstr("changes direction along the "));
    }
  }
}

// A line with equal values at its ends has no direction: attribute 1 is 1 everywhere.
TEST(Monotone, FindsWhatLeavesTheEndsOfALevelLine) {
  const auto violations = [](float actual) {
    return checked(square(),
                   [actual](const Case&, Fragments& drawn) { value(drawn, 0, 2, 2, 1) = actual; })
        .violation_count;
  };
  EXPECT_EQ(violations(1 + 0x1p-23F), 0U);  // one ulp is allowed
  EXPECT_EQ(violations(1 + 0x1p-21F), 1U);
  EXPECT_EQ(violations(1 - 0x1p-21F), 1U);
  EXPECT_EQ(violations(std::numeric_limits<float>::quiet_NaN()), 1U);
}

TEST(Monotone, FindsDepths) {
  const Check check = checked(
      square(), [](const Case&, Fragments& drawn) { drawn.depth[find(drawn, 0, 2, 2)] = 0.375F; });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().kind, AttributeKind::depth);
}

TEST(Monotone, SaysNothingOfFlatValuesAndOtherPlaces) {
  const auto violations = [](cases::Interpolation interpolation, cases::Location location) {
    Case c = square();
    c.attributes[1] = {"one", interpolation, location};
    return checked(c, [](const Case&, Fragments& drawn) { value(drawn, 0, 2, 2, 1) = 2; })
        .violation_count;
  };
  using cases::Interpolation;
  using cases::Location;
  EXPECT_EQ(violations(Interpolation::smooth, Location::sample), 1U);
  EXPECT_EQ(violations(Interpolation::smooth, Location::center), 1U);
  EXPECT_EQ(violations(Interpolation::smooth, Location::centroid), 0U);
  EXPECT_EQ(violations(Interpolation::flat, Location::sample), 0U);
}

}  // namespace
}  // namespace rastercheck::properties::values_are_monotone_along_lines_test
