// The law catches a sample of a triangle that none of its sides as wide lines has.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/primitive_scenes.h"

namespace rastercheck::properties::wide_lines_fill_their_triangle_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "wide-lines-fill-their-triangle";

Check checked(const Case& c, const Damage& damage = {}) { return check_of(kLaw, c, damage, "cpu"); }

/// The triangle (1, 1), (7, 1), (1, 7).
Case inner_triangle() {
  Case c = square();
  c.positions = {{-0.75F, -0.75F, 0.25F, 1}, {0.75F, -0.75F, 0.25F, 1}, {-0.75F, 0.75F, 0.25F, 1}};
  c.attribute_values.resize(9);
  c.triangles = {{0, 1, 2}};
  return c;
}

TEST(WideLines, FillTheirTriangle) {
  const Check check = checked(inner_triangle());
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 15U);
  EXPECT_FALSE(checked(level_line()).is_applicable);
}

TEST(WideLines, LeaveOutASample) {
  const Check check = checked(inner_triangle(), [](const Case& c, Fragments& drawn) {
    if (c.primitive != cases::Primitive::lines) return;
    for (std::uint32_t side = 0; side < 3; ++side) {
      if (is_drawn(drawn, side, 2, 2)) drop(drawn, side, 2, 2);
    }
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().exact, "required: the triangle has it");
}

}  // namespace
}  // namespace rastercheck::properties::wide_lines_fill_their_triangle_test
