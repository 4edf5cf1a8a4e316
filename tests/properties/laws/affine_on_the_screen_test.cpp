// The law catches curved values of attributes that must be affine, and quotients that do not match;
// it ignores smooth values and clamped depths.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::affine_on_the_screen_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "1-w-and-r-w-are-affine-on-the-screen";

/// The square with w = 1, 2, 4 and 8 at its vertices; r/w is 0, 1, 2 and 3 there.
Case weighted() {
  Case c = square();
  c.attributes = {{"r", cases::Interpolation::smooth, cases::Location::sample},
                  {"r/w", cases::Interpolation::noperspective, cases::Location::sample},
                  {"1/w", cases::Interpolation::noperspective, cases::Location::sample}};
  c.attribute_values.clear();
  constexpr std::array kWeights{1.0F, 2.0F, 4.0F, 8.0F};
  for (std::size_t i = 0; i < 4; ++i) {
    const float w = kWeights[i];
    cases::ClipVertex& p = c.positions[i];
    p = {p.x * w, p.y * w, p.z * w, w};
    const auto q = static_cast<float>(i);
    c.attribute_values.insert(c.attribute_values.end(), {q * w, q, 1 / w});
  }
  return c;
}

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// Changes attribute `a` at pixel (2, 2), in the middle of the law's lines through triangle A.
Damage adding(float more, std::size_t a) {
  return [more, a](const Case&, Fragments& drawn) { value(drawn, 0, 2, 2, a) += more; };
}

TEST(Affine, HoldsOfTheSquare) {
  const Check check = checked(weighted(), {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::IsSupersetOf({"depth", "noperspective", "quotient"}));
}

TEST(Affine, FindsAQuotientThatIsNone) {
  const Check check = checked(weighted(), adding(0.001F, 0));
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.kind, AttributeKind::smooth);
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(violation.attribute, 0U);
  EXPECT_EQ(violation.place.x, 2U);
  EXPECT_EQ(violation.place.y, 2U);
  EXPECT_THAT(violation.note, testing::HasSubstr("and 1/w"));
}

// Without the quotient's attributes, the law compares values with a chord in any direction.
TEST(Affine, FindsWhatIsNotOnTheChord) {
  Case c = weighted();
  c.attributes[0].interpolation = cases::Interpolation::noperspective;
  const Check check = checked(c, adding(0.001F, 0));
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().kind, AttributeKind::noperspective);
  EXPECT_THAT(check.violations.front().note, testing::HasSubstr("not on the chord of its "));
  const Check depth = checked(
      c, [](const Case&, Fragments& drawn) { drawn.depth[find(drawn, 0, 2, 2)] += 0.001F; });
  ASSERT_EQ(depth.violation_count, 1U);
  EXPECT_EQ(depth.violations.front().kind, AttributeKind::depth);
}

TEST(Affine, LeavesWhatTheBoundLeaves) {
  const auto violations = [](float ulps) {
    return checked(weighted(), adding(ulps * 0x1p-23F, 2)).violation_count;
  };
  EXPECT_EQ(violations(0.5F), 0U);
  EXPECT_GT(violations(4), 0U);
}

TEST(Affine, SaysNothingOfSmoothValuesAndClampedDepths) {
  Case c = weighted();
  for (cases::Attribute& attribute : c.attributes) {
    attribute.interpolation = cases::Interpolation::smooth;
  }
  EXPECT_EQ(checked(c, adding(77, 1)).violation_count, 0U);
  c.depth_clamp = true;
  EXPECT_FALSE(checked(c, {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::affine_on_the_screen_test
