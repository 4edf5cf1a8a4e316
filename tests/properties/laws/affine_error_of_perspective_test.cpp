// The law catches values farther from perspective than the ratio of the vertices' w allows, in
// either direction. It accepts all values in between, and does not apply to backends that claim
// perspective.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::affine_error_of_perspective_test {
namespace {

using cases::Case;
using cases::Fragments;

constexpr std::string_view kLaw = "affine-values-are-off-perspective-by-no-more-than-w-allows";

/// Over 8 × 8 pixels, w = 1 and r = 0 on the left side, w = 4 and r = 1 at the vertex on the right.
/// At u = 2 1/2 the weight of that vertex is 5/16 in the window and, in perspective, 5/64 over
/// 11/16 + 5/64, which is 5/49. κ = (2 − 1)/(2 + 1), so values from −0.2313 to 0.4354 are allowed.
Case wedge() {
  Case c;
  c.rules = cases::Rules::vulkan;
  c.framebuffer = {8, 8, 1};
  c.viewport.width = 8;
  c.viewport.height = 8;
  c.attributes = {{"r", cases::Interpolation::smooth, cases::Location::sample}};
  c.positions = {{-1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}, {4, 0, 2, 4}};
  c.attribute_values = {0, 0, 1};
  c.triangles = {{0, 1, 2}};
  return c;
}

Check checked_with(float actual, const std::string& backend = "method:screen-linear") {
  return check_of(
      kLaw, wedge(), [actual](const Case&, Fragments& drawn) { value(drawn, 0, 2, 3, 0) = actual; },
      backend);
}

TEST(AffineError, IsWithinWhatTheRatioOfWAllows) {
  for (const float right : {0.3125F, 0.435F, -0.231F}) {
    const Check check = checked_with(right);
    EXPECT_TRUE(check.is_applicable);
    EXPECT_EQ(check.violation_count, 0U) << right;
  }
}

TEST(AffineError, IsFoundBeyondIt) {
  for (const float wrong : {0.436F, -0.232F}) {
    const Check check = checked_with(wrong);
    ASSERT_EQ(check.violation_count, 1U) << wrong;
    EXPECT_EQ(check.violations.front().fragment_class, records::FragmentClass::beyond_bound);
    EXPECT_EQ(check.violations.front().place.x, 2U);
    EXPECT_EQ(check.violations.front().place.y, 3U);
    EXPECT_EQ(check.violations.front().attribute, 0U);
  }
}

// A triangle behind the eye has no well-defined image in the window.
TEST(AffineError, SaysNothingWhereSomeWIsNotPositive) {
  Case c = wedge();
  c.positions[2] = {-4, 0, -2, -4};
  EXPECT_FALSE(check_of(kLaw, c, {}, "method:screen-linear").is_applicable);
}

TEST(AffineError, DoesNotApplyToMethodsInPerspective) {
  EXPECT_FALSE(checked_with(2, "cpu").is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::affine_error_of_perspective_test
