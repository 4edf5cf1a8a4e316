// The law catches samples that the parts of a triangle lose, draw twice, or draw with other values
// than the whole; it lets values differ by the sum of both bounds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "properties/float_numbers.h"
#include "properties/law.h"
#include "properties/laws/internal/close_drawings.h"
#include "properties/laws/internal/parted_triangles.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::splitting_a_triangle_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "splitting-a-triangle-changes-nothing-beyond-the-bound";

Check checked(const Case& c, const Damage& damage, const std::string& specification = "cpu") {
  return check_of(kLaw, c, damage, specification);
}

/// True if the square's two triangles are split.
bool is_parted(const Case& c) { return c.triangles.size() > 2; }

TEST(Splitting, OfTheSquareDrawsIt) {
  std::vector<Case> seen;
  const Check check = checked(square(), [&seen](const Case& c, Fragments&) { seen.push_back(c); });
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].triangles.size(), 2U);
  EXPECT_GE(seen[1].triangles.size(), 4U);
  EXPECT_EQ(seen[0].positions[1], square().positions[1]);
}

TEST(Splitting, MakesAttributesSmoothAtTheSample) {
  Case c = square();
  c.attributes[0].interpolation = cases::Interpolation::flat;
  c.attributes[1].location = cases::Location::centroid;
  c.depth_test = cases::DepthTest::less;
  const Check check = checked(c, [](const Case& drawn, Fragments&) {
    EXPECT_EQ(drawn.depth_test, cases::DepthTest::none);
    for (const cases::Attribute& attribute : drawn.attributes) {
      EXPECT_EQ(attribute.interpolation, cases::Interpolation::smooth);
      EXPECT_EQ(attribute.location, cases::Location::sample);
    }
  });
  EXPECT_EQ(check.violation_count, 0U);
}

TEST(Splitting, FindsWhatAPartLosesOrDrawsTwice) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (!is_parted(c)) return;
    drop(drawn, drawn.triangle[0], drawn.x[0], drawn.y[0]);
    add(drawn, drawn.triangle[20], drawn.x[20], drawn.y[20]);
    add(drawn, 99, 1, 1);
  });
  EXPECT_EQ(check.violation_count, 3U);
  EXPECT_EQ(check.violations.back().fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations.back().note, "drawn in parts");
}

// Attribute 0 is at most 8, and two bounds of 0.51 are 1.02 ulp(8).
TEST(Splitting, FindsValuesBeyondBothBounds) {
  for (const float units : {1.0F, 2.0F}) {
    const Check check = checked(square(), [units](const Case& c, Fragments& drawn) {
      if (is_parted(c)) drawn.attributes[3 * 10] += units * 0x1p-20F;
    });
    EXPECT_EQ(check.violation_count, units == 1 ? 0U : 1U);
  }
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_parted(c)) drawn.depth[5] = std::nanf("");
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().kind, records::AttributeKind::depth);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::not_a_number);
}

// For snapped triangles, a sample near the outline may be lost, but a sample in the middle of a
// triangle may not.
TEST(Splitting, LeavesTheOutlineOfSnappedTrianglesAlone) {
  Case c = square();
  c.coverage = cases::Snapping{4};
  c.triangles = {{0, 1, 2}};
  const auto dropping = [](int x, int y) {
    return [x, y](const Case& drawn_case, Fragments& drawn) {
      if (drawn_case.triangles.size() == 1) return;
      for (std::uint32_t part = 0; part < drawn_case.triangles.size(); ++part) {
        if (find(drawn, part, x, y) < drawn.size()) return drop(drawn, part, x, y);
      }
    };
  };
  EXPECT_EQ(checked(c, dropping(1, 1)).violation_count, 1U);
  c.positions[2] = {-1, 0.998F, 0.25F, 1};
  EXPECT_EQ(checked(c, {}).violation_count, 0U);
  Case moved = c;
  moved.viewport.x = 0.45F;  // the left edge is next to the centres of column 0
  EXPECT_EQ(checked(moved, dropping(0, 2)).violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::splitting_a_triangle_test
