// The law catches values that are clamped to a range, off by more than both bounds, or copied
// without the change, and coverage and depth that depend on attributes. It accepts rounding errors.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::scaled_attributes_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::Contains;
using testing::HasSubstr;

constexpr std::string_view kLaw = "a-scaled-and-moved-attribute-is-scaled-and-moved";
constexpr int kNumbers = 32;

Check checked(const Case& c, const Damage& damage, const std::string& specification = "cpu") {
  return check_of(kLaw, c, damage, specification);
}

/// The square; another number makes the law choose another change.
Case numbered(int number) {
  Case c = square();
  c.attribute_values[1] = static_cast<float>(number);
  return c;
}

/// The change of attribute 0, α r + β; it was 0 at vertex 0 and 8 at vertex 1.
struct Change {
  float alpha = 0;
  float beta = 0;
};

Change change_of(const Case& c) {
  const float beta = c.attributes_of(0)[0];
  return {(c.attributes_of(1)[0] - beta) / 8, beta};
}

bool is_changed(const Case& c) {
  const Change change = change_of(c);
  return change.alpha != 1 || change.beta != 0;
}

/// A case whose change is a scaling alone, or is not.
Case changed_so(bool is_scaled_only) {
  for (int number = 0; number < kNumbers; ++number) {
    Change change;
    checked(numbered(number), [&](const Case& c, Fragments&) { change = change_of(c); });
    if ((change.beta == 0) == is_scaled_only) return numbered(number);
  }
  ADD_FAILURE() << is_scaled_only;
  return square();
}

TEST(ScaledAttributes, AreScaledAndMoved) {
  std::set<std::string> labels;
  std::set<float> alphas;
  for (const char* specification : {"cpu", "cpu:precision=float32", "method:rational-linear"}) {
    for (int number = 0; number < kNumbers; ++number) {
      Case c = numbered(number);
      c.attributes[2].interpolation = cases::Interpolation::flat;
      const Check check = checked(
          c, [&](const Case& drawn, Fragments&) { alphas.insert(change_of(drawn).alpha); },
          specification);
      EXPECT_TRUE(check.is_applicable);
      EXPECT_EQ(check.violation_count, 0U);
      EXPECT_EQ(check.judgement.counts.required, 64U);
      labels.insert(check.labels.begin(), check.labels.end());
    }
  }
  EXPECT_THAT(labels, testing::IsSupersetOf({"flat", "open value", "scaled", "scaled and moved"}));
  EXPECT_GT(alphas.size(), 8U);
}

// Clamps values to 0 and above, as for colours.
TEST(ScaledAttributes, FindValuesThatAreHeldToARange) {
  int found = 0;
  for (int number = 0; number < kNumbers; ++number) {
    float least = 0;
    const Check check = checked(numbered(number), [&](const Case& c, Fragments& drawn) {
      for (float& value : drawn.attributes) value = std::max(value, 0.0F);
      for (const float value : c.attribute_values) least = std::min(least, value);
    });
    EXPECT_EQ(check.violation_count > 0, least < 0);
    if (check.violation_count == 0) continue;
    ++found;
    EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
    EXPECT_THAT(check.violations.front().note, HasSubstr("for the original value r"));
  }
  EXPECT_GT(found, 0);
}

TEST(ScaledAttributes, FindALastBitWhereNothingIsAdded) {
  const Check check = checked(changed_so(true), [](const Case& c, Fragments& drawn) {
    if (!is_changed(c)) return;
    float& attribute = value(drawn, 1, 5, 5, 0);
    attribute = std::nextafter(attribute, 0.0F);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().place.x, 5U);
  EXPECT_EQ(check.violations.front().attribute, 0U);
  EXPECT_THAT(check.labels, Contains("scaled"));
}

// Both bounds are measured in the ULP of the largest value at a vertex.
TEST(ScaledAttributes, AreWithinBothBoundsWhereSomethingIsAdded) {
  const Case c = changed_so(false);
  const auto off_by = [&](double share) {
    return checked(c, [share](const Case& drawn_of, Fragments& drawn) {
      if (!is_changed(drawn_of)) return;
      const auto [alpha, beta] = change_of(drawn_of);
      const float most = std::max(std::abs(beta), std::abs(8 * alpha + beta));
      const double unit = std::ldexp(1.0, std::ilogb(most) - 23);
      const double bounds = 0.51F * (unit + double{std::abs(alpha)} * 0x1p-20);
      // Rounding to float32 must not carry the value beyond the bounds.
      const double exact = double{alpha} * 5.5 + double{beta};
      auto moved = static_cast<float>(exact + share * bounds);
      if (share < 1 && moved - exact > bounds) moved = std::nextafter(moved, -1e6F);
      value(drawn, 1, 5, 5, 0) = moved;
    });
  };
  EXPECT_EQ(off_by(0.9).violation_count, 0U);
  const Check check = off_by(4);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
  EXPECT_THAT(check.violations.front().note, HasSubstr("within the bounds of both drawings"));
  EXPECT_THAT(check.labels, Contains("scaled and moved"));
}

TEST(ScaledAttributes, FindWhatIsNoNumber) {
  const Check check = checked(changed_so(false), [](const Case& c, Fragments& drawn) {
    if (is_changed(c)) value(drawn, 1, 5, 5, 0) = std::numeric_limits<float>::quiet_NaN();
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::not_a_number);
}

TEST(ScaledAttributes, FindCoverageAndDepthThatDependOnThem) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (!is_changed(c)) return;
    drop(drawn, 1, 7, 7);
    drawn.depth[find(drawn, 1, 6, 7)] += 0x1p-24F;
  });
  EXPECT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations.back().kind, records::AttributeKind::depth);
}

TEST(ScaledAttributes, FindFlatValuesOfAnotherVertex) {
  Case c = square();
  c.attributes[0].interpolation = cases::Interpolation::flat;
  const Check check = checked(c, [](const Case& drawn_of, Fragments& drawn) {
    if (is_changed(drawn_of)) value(drawn, 0, 0, 0, 0) = drawn_of.attributes_of(1)[0];
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().kind, records::AttributeKind::flat);
}

TEST(ScaledAttributes, SayNothingOfValuesThatCannotBeScaled) {
  Case c = square();
  for (float& value : c.attribute_values) value = 0x1.fffffep127F;
  for (std::size_t v = 0; v < 4; v += 2) {
    for (std::size_t a = 0; a < 3; ++a) c.attribute_values[3 * v + a] = 0x1p-149F;
  }
  // The values are at both ends of float32's range, so that α can only be ±1. Another depth makes
  // the law choose differently.
  int negated = 0;
  for (int number = 0; number < kNumbers; ++number) {
    c.positions[0].z = static_cast<float>(number) / 64;
    checked(c, [&](const Case& drawn, Fragments&) {
      negated += drawn.attributes_of(1)[0] < 0 ? 1 : 0;
      EXPECT_EQ(std::abs(drawn.attributes_of(1)[0]), 0x1.fffffep127F);
      EXPECT_EQ(std::abs(drawn.attributes_of(2)[0]), 0x1p-149F);
    });
  }
  EXPECT_GT(negated, 0);
  c.attributes.clear();
  c.attribute_values.clear();
  EXPECT_FALSE(checked(c, {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::scaled_attributes_test
