// The law catches samples in another order, upside down, or half a pixel off; it ignores attributes
// that are not window positions.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::sample_positions_are_the_patterns_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "sample-positions-are-the-patterns";

/// The square with its window positions as attributes.
Case positions(int samples, cases::Location location = cases::Location::sample) {
  Case c = square();
  c.framebuffer.samples = samples;
  c.attributes = {{"u", cases::Interpolation::noperspective, location},
                  {"v", cases::Interpolation::noperspective, location}};
  c.attribute_values = {0, 0, 8, 0, 0, 8, 8, 8};
  return c;
}

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

TEST(SamplePositions, AreThoseOfAllPatternsUnderAllRules) {
  for (const int samples : {1, 2, 4, 8, 16}) {
    for (const cases::Rules rules :
         {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
      for (const cases::Location location :
           {cases::Location::sample, cases::Location::center, cases::Location::centroid}) {
        Case c = positions(samples, location);
        c.rules = rules;
        c.fill_rule = cases::default_fill_rule(rules);
        if (rules == cases::Rules::d3d) {  // D3D's window y points down
          for (cases::ClipVertex& p : c.positions) p.y = -p.y;
        }
        const Check check = checked(c, {});
        EXPECT_TRUE(check.is_applicable);
        EXPECT_EQ(check.violation_count, 0U) << samples;
        EXPECT_EQ(check.judgement.counts.required, 64U * static_cast<unsigned>(samples));
      }
    }
  }
}

TEST(SamplePositions, FindsOneFloatAndNamesIt) {
  const Check check = checked(positions(1), [](const Case&, Fragments& drawn) {
    value(drawn, 0, 2, 3, 1) = std::nextafter(3.5F, 8.0F);
    value(drawn, 1, 6, 6, 1) = std::nextafter(6.5F, 8.0F);
  });
  ASSERT_EQ(check.violation_count, 2U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(violation.kind, AttributeKind::noperspective);
  EXPECT_EQ(violation.attribute, 1U);
  EXPECT_EQ(violation.place.x, 2U);
  EXPECT_EQ(violation.place.y, 3U);
  EXPECT_EQ(violation.exact, "3.5 (0x1.cp+1)");
  EXPECT_EQ(violation.note, "not the window y of the sample position");
}

// Sample k takes the values of sample 3 − k; inside the triangles this does not change coverage.
TEST(SamplePositions, FindsAnotherOrder) {
  const Check check = checked(positions(4), [](const Case&, Fragments& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      drawn.sample[i] = static_cast<std::uint8_t>(3 - drawn.sample[i]);
    }
  });
  EXPECT_GT(check.violation_count, 300U);
}

TEST(SamplePositions, FindsHalfAPixel) {
  const Check check = checked(positions(1), [](const Case&, Fragments& drawn) {
    for (float& value : drawn.attributes) value -= 0.5F;
  });
  EXPECT_EQ(check.violation_count, 128U);
}

TEST(SamplePositions, LetsCentroidsBeAnywhereInThePixel) {
  const auto violations = [](float actual) {
    return checked(positions(4, cases::Location::centroid),
                   [actual](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 0) = actual; })
        .violation_count;
  };
  EXPECT_EQ(violations(2), 0U);
  EXPECT_EQ(violations(3), 0U);
  EXPECT_EQ(violations(3.125F), 1U);
}

TEST(SamplePositions, SaysNothingOfOtherAttributes) {
  EXPECT_FALSE(checked(square(), {}).is_applicable);
  Case c = positions(1);
  c.attribute_values[0] = 1;  // of triangle A only
  EXPECT_EQ(checked(c, {}).judgement.counts.required, 36U);
  c.attribute_values[2] = 7;
  EXPECT_FALSE(checked(c, {}).is_applicable);
  Case smooth = positions(1);
  for (cases::Attribute& a : smooth.attributes) a.interpolation = cases::Interpolation::smooth;
  EXPECT_TRUE(checked(smooth, {}).is_applicable);
  smooth.positions[1] = {2, -2, 0.5F, 2};  // a vertex of both triangles
  EXPECT_FALSE(checked(smooth, {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::sample_positions_are_the_patterns_test
