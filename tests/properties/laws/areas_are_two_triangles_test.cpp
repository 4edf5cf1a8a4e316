// The law catches points and lines that differ from the two triangles that they consist of.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::areas_are_two_triangles_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "points-and-parallelograms-are-two-triangles";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

Case parallelogram() {
  Case c = level_line();
  c.line_mode = cases::LineMode::parallelogram;
  return c;
}

TEST(TwoTriangles, AreAPointOrALine) {
  EXPECT_EQ(checked(two_points()).violation_count, 0U);
  EXPECT_EQ(checked(parallelogram()).violation_count, 0U);
  EXPECT_FALSE(checked(level_line()).is_applicable);
}

TEST(TwoTriangles, LackASample) {
  const Damage damage = [](const Case& c, Fragments& drawn) {
    if (c.primitive != cases::Primitive::triangles) drop(drawn, 0, 3, 2);
  };
  EXPECT_EQ(checked(two_points(), damage).violation_count, 1U);
  const Check check = checked(parallelogram(), damage);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
}

TEST(TwoTriangles, HaveOtherValues) {
  const Check check = checked(parallelogram(), [](const Case& c, Fragments& drawn) {
    if (c.primitive != cases::Primitive::triangles) drawn.attributes[0] += 1;
  });
  EXPECT_EQ(check.violation_count, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::areas_are_two_triangles_test
