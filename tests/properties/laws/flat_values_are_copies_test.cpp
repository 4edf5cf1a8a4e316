// The law catches the other vertex's value and the zero of the other sign, also at samples that
// should not be drawn; it ignores interpolated attributes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::flat_values_are_copies_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "flat-values-are-the-provoking-vertex";

/// Attribute 2 is flat: −0 at vertex 0, a subnormal at vertex 1, and 0 elsewhere.
Case flat() {
  Case c = square();
  c.attributes[2].interpolation = cases::Interpolation::flat;
  c.attribute_values[2] = -0.0F;
  c.attribute_values[5] = 0x1p-149F;
  return c;
}

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

TEST(FlatValues, AreTheFirstVertexsOrTheLast) {
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    Case c = flat();
    c.rules = rules;
    const Check check = checked(c, {});
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_EQ(check.judgement.counts.required, 64U);
    const bool is_first = rules != cases::Rules::opengl;
    EXPECT_EQ(testing::Value(check.labels, testing::Contains("negative zero")), is_first);
    // The first vertex of A is −0, the last vertex of B is 0.
    const Check other =
        checked(c, [](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 2) = 0x1p-149F; });
    EXPECT_EQ(other.violation_count, 1U);
  }
}

TEST(FlatValues, FindsTheOtherZero) {
  const Check check =
      checked(flat(), [](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 2) = 0; });
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.kind, AttributeKind::flat);
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(violation.attribute, 2U);
  EXPECT_EQ(violation.place.x, 2U);
  EXPECT_EQ(violation.place.y, 3U);
  EXPECT_EQ(violation.note, "the provoking vertex is 0");
}

TEST(FlatValues, JudgesSamplesThatShouldNotBeThere) {
  const Check check = checked(flat(), [](const Case&, Fragments& drawn) { add(drawn, 0, 7, 7); });
  EXPECT_EQ(check.violation_count, 1U);
}

TEST(FlatValues, SaysNothingOfInterpolatedOnes) {
  EXPECT_FALSE(checked(square(), {}).is_applicable);
  const Check check =
      checked(flat(), [](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 0) = 77; });
  EXPECT_EQ(check.violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::flat_values_are_copies_test
