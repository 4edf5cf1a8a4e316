// The law catches derivatives beyond the bound along either axis; it does not apply if none are
// promised, or if their place is open.

#include <gtest/gtest.h>

#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::derivatives_stay_within_the_bound_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "screen-derivatives-stay-within-the-bound";

/// Checks a backend that gives derivatives and has this damage.
Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// ∂/∂u (axis 0) or ∂/∂v (axis 1) of an attribute.
float& derivative(Fragments& drawn, std::uint32_t triangle, int x, int y, std::size_t attribute,
                  std::size_t axis) {
  const std::size_t first = find(drawn, triangle, x, y) * drawn.attribute_count;
  return drawn.derivatives[(first + attribute) * 2 + axis];
}

// Attribute 0 is u: its derivatives are 1 and 0, and the unit of both is ulp(8/8 + 8/8) = 2^-22.
TEST(ScreenDerivatives, FindsOneUnitAlongEitherAxis) {
  const Check check = checked(square(), [](const Case&, Fragments& drawn) {
    derivative(drawn, 0, 2, 3, 0, 0) = 1 + 0x1p-22F;
    derivative(drawn, 0, 3, 3, 0, 0) = 1 + 0x1p-23F;  // half a unit
    derivative(drawn, 1, 6, 6, 0, 1) = -0x1p-22F;
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::beyond_bound, AttributeKind::smooth, 0, 2, 3);
  EXPECT_EQ(check.violations[0].attribute, 0U);
  EXPECT_EQ(check.violations[0].exact, "1");
  EXPECT_TRUE(records::contains(check.violations[0].error.value(), 1));
  EXPECT_EQ(check.violations[0].note, "the derivative along window x");
  expect_at(check.violations[1], FragmentClass::beyond_bound, AttributeKind::smooth, 1, 6, 6);
  EXPECT_EQ(check.violations[1].exact, "0");
  EXPECT_TRUE(records::contains(check.violations[1].error.value(), -1));
  EXPECT_EQ(check.violations[1].note, "the derivative along window y");
}

TEST(ScreenDerivatives, FindsWhatIsNoNumber) {
  const Check check = checked(square(), [](const Case&, Fragments& drawn) {
    derivative(drawn, 0, 1, 1, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    derivative(drawn, 0, 1, 1, 2, 1) = std::numeric_limits<float>::infinity();
  });
  ASSERT_EQ(check.violation_count, 2U);
  expect_at(check.violations[0], FragmentClass::not_a_number, AttributeKind::smooth, 0, 1, 1);
  EXPECT_EQ(check.violations[0].actual, "nan");
  expect_at(check.violations[1], FragmentClass::infinite, AttributeKind::smooth, 0, 1, 1);
}

TEST(ScreenDerivatives, FindsSlopesOfFlatAttributes) {
  Case c = square();
  c.attributes[0].interpolation = cases::Interpolation::flat;
  EXPECT_EQ(checked(c, {}).violation_count, 0U);
  const Check check = checked(
      c, [](const Case&, Fragments& drawn) { derivative(drawn, 0, 1, 1, 0, 0) = 0x1p-149F; });
  expect_at(only(check), FragmentClass::beyond_bound, AttributeKind::flat, 0, 1, 1);
}

// Under OpenGL and Vulkan a centroid may be anywhere in the triangle's part of a pixel.
TEST(ScreenDerivatives, JudgesNoCentroidWhosePlaceIsOpen) {
  const auto violations = [](cases::Rules rules, int samples) {
    Case c = square();
    c.rules = rules;
    c.framebuffer.samples = samples;
    c.attributes[0].location = cases::Location::centroid;
    const auto damage = [](const Case&, Fragments& drawn) { drawn.derivatives[0] = 7; };
    return checked(c, damage).violation_count;
  };
  EXPECT_EQ(violations(cases::Rules::vulkan, 1), 1U);
  EXPECT_EQ(violations(cases::Rules::vulkan, 4), 0U);
  EXPECT_EQ(violations(cases::Rules::d3d, 4), 1U);
}

TEST(ScreenDerivatives, SaysNothingWhereNoneArePromisedOrGiven) {
  EXPECT_FALSE(check_of(kLaw, square(), {}).is_applicable);
  EXPECT_FALSE(checked(square(), [](const Case&, Fragments& drawn) {
                 drawn.derivatives.clear();
               }).is_applicable);
  DamagedBackend backend({}, "cpu");
  cases::Contract contract = backend.contract(square());
  contract.derivative_bound.reset();
  backend.promised = contract;
  EXPECT_FALSE(check_of(kLaw, square(), backend).is_applicable);
  Case c = square();
  c.attributes.clear();
  c.attribute_values.clear();
  EXPECT_FALSE(checked(c, {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::derivatives_stay_within_the_bound_test
