// The law catches values, and depths, that are one float beyond those of the vertices, however
// large the scale ULP is. It allows the part of a contract's bound that exceeds the rounding.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::values_in_range_of_vertices_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "values-stay-in-the-range-of-their-vertices";

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// Attribute 0 runs from −1024 to 0, so that its scale ULP is 2^-13.
Case below_zero() {
  Case c = square();
  for (std::size_t i = 0; i < 4; ++i) c.attribute_values[i * 3] *= -128;
  return c;
}

TEST(RangeOfVertices, FindsOneFloatBeyond) {
  const Check check = checked(square(), [](const Case&, Fragments& drawn) {
    value(drawn, 0, 2, 3, 1) = std::nextafter(1.0F, 2.0F);
    value(drawn, 0, 3, 3, 1) = std::nextafter(1.0F, 0.0F);
    value(drawn, 1, 6, 6, 0) = std::numeric_limits<float>::infinity();
  });
  ASSERT_EQ(check.violation_count, 3U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(violation.kind, AttributeKind::smooth);
  EXPECT_EQ(violation.attribute, 1U);
  EXPECT_EQ(violation.place.x, 2U);
  EXPECT_EQ(violation.place.y, 3U);
  EXPECT_EQ(violation.note, "beyond the values of all three vertices");
  EXPECT_EQ(check.violations.back().fragment_class, FragmentClass::infinite);
}

TEST(RangeOfVertices, LetsValuesBeAnywhereBetween) {
  const Check check =
      checked(square(), [](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 0) = 7.5F; });
  EXPECT_EQ(check.violation_count, 0U);
}

// cpu promises 0.51 scale ULP: 0.01 more than the rounding, in units of 2^-13.
TEST(RangeOfVertices, LeavesWhatTheBoundHasBesidesTheRounding) {
  const auto violations = [](float actual) {
    return checked(below_zero(),
                   [actual](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 0) = actual; })
        .violation_count;
  };
  EXPECT_EQ(violations(0x1p-20F), 0U);
  EXPECT_EQ(violations(0x1p-19F), 1U);
}

// If several roundings share a bound, all of it is allowed.
TEST(RangeOfVertices, LeavesTheWholeOfAGreaterBound) {
  DamagedBackend backend({}, "cpu");
  cases::Contract contract = backend.contract(square());
  contract.bounds.smooth = {2, 0};
  backend.promised = contract;
  const auto violations = [&backend](int floats) {
    Case c = square();
    DamagedBackend damaged(
        [floats](const Case&, Fragments& drawn) {
          value(drawn, 0, 2, 3, 1) = 1 + static_cast<float>(floats) * 0x1p-23F;
        },
        "cpu");
    damaged.promised = backend.promised;
    return check_of(kLaw, c, damaged).violation_count;
  };
  EXPECT_EQ(violations(2), 0U);
  EXPECT_EQ(violations(3), 1U);
}

TEST(RangeOfVertices, FindsDepthsBeyondTheVertices) {
  const auto violations = [](float depth) {
    return checked(square(),
                   [depth](const Case&, Fragments& drawn) {
                     drawn.depth[find(drawn, 0, 2, 3)] = depth;
                   })
        .violation_count;
  };
  EXPECT_EQ(violations(0.25F), 0U);
  EXPECT_EQ(violations(0.25F + 0x1p-20F), 1U);
  EXPECT_EQ(violations(0.25F - 0x1p-20F), 1U);
}

TEST(RangeOfVertices, SaysNothingOfFlatAndFreeValuesAndOfCentresOutside) {
  const auto is_judged = [](cases::Interpolation interpolation, cases::Location location,
                            int samples, float w) {
    Case c = square();
    c.framebuffer.samples = samples;
    c.attributes[0] = {"x", interpolation, location};
    c.positions[1].w = w;
    const Check check = checked(c, [](const Case&, Fragments& drawn) {
      for (std::size_t i = 0; i < drawn.size(); ++i) drawn.attributes[i * 3] = 9;
    });
    return check.violation_count > 0;
  };
  using cases::Interpolation;
  using cases::Location;
  EXPECT_TRUE(is_judged(Interpolation::smooth, Location::sample, 1, 1));
  EXPECT_TRUE(is_judged(Interpolation::noperspective, Location::sample, 1, 1));
  EXPECT_TRUE(is_judged(Interpolation::smooth, Location::centroid, 4, 1));
  EXPECT_FALSE(is_judged(Interpolation::flat, Location::sample, 1, 1));
  EXPECT_FALSE(is_judged(Interpolation::smooth, Location::center, 4, 1));
  EXPECT_FALSE(is_judged(Interpolation::noperspective, Location::sample, 1, -1));
}

TEST(RangeOfVertices, LeavesSamplesThatShouldNotBeThereAlone) {
  const Check check = checked(square(), [](const Case&, Fragments& drawn) {
    add(drawn, 0, 7, 7);
    drawn.attributes.back() = 9;
  });
  EXPECT_EQ(check.violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::values_in_range_of_vertices_test
