// The law catches a division that is forgotten, or made although none is wanted, and values, depths
// and coverage that differ between the two paths; it accepts differences up to the sum of both
// bounds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::equal_w_equals_the_general_path_test {
namespace {

using cases::Case;
using cases::Fragments;
using testing::HasSubstr;

constexpr std::string_view kLaw = "equal-w-equals-the-general-path";

Check checked(const Case& c, const Damage& damage, const std::string& specification = "cpu") {
  return check_of(kLaw, c, damage, specification);
}

/// True for the scaled triangles, which have two more attributes.
bool is_general(const Case& c) { return c.attributes.size() > 3; }

TEST(EqualW, DrawsTheSquareWithVerticesScaled) {
  Case equal;
  Case general;
  const Check check =
      checked(square(), [&](const Case& c, Fragments&) { (is_general(c) ? general : equal) = c; });
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  EXPECT_THAT(check.labels, testing::Contains("quotient"));
  std::set<float> weights;
  for (std::size_t v = 0; v < 4; ++v) {
    const cases::ClipVertex& p = general.positions[v];
    EXPECT_EQ(equal.positions[v].w, equal.positions[0].w);
    EXPECT_EQ(p.x / p.w, square().positions[v].x);
    EXPECT_EQ(p.z / p.w, 0.25F);
    EXPECT_EQ(general.attributes_of(v)[0], equal.attributes_of(v)[0]);
    EXPECT_EQ(general.attributes_of(v)[4], p.w / equal.positions[v].w);
    EXPECT_EQ(general.attributes_of(v)[3],
              general.attributes_of(v)[0] * p.w / equal.positions[v].w);
    weights.insert(p.w);
  }
  EXPECT_GT(weights.size(), 1U);
}

TEST(EqualW, ScalesClipDistancesAlike) {
  Case c = square();
  c.clip_distance_count = 1;
  c.clip_distances = {-3.5F, 4.5F, -3.5F, 4.5F};
  const Check check = checked(c, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 40U);  // columns 3 to 7; column 3's zeros are inside
}

TEST(EqualW, FindsCoverageOfOneOnly) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_general(c)) drop(drawn, 0, 1, 1);
    if (!is_general(c)) drop(drawn, 1, 6, 6);
  });
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("another power of two"));
}

// The sum of both bounds is 1.02 · 2^-20: 0.51 ulp(8) for each.
TEST(EqualW, FindsValuesBeyondBothBounds) {
  for (const float units : {1.0F, 2.0F}) {
    const Check check = checked(square(), [units](const Case& c, Fragments& drawn) {
      if (is_general(c)) value(drawn, 0, 1, 1, 0) += units * 0x1p-20F;
    });
    EXPECT_EQ(check.violation_count, units == 1 ? 0U : 1U);
  }
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (!is_general(c)) drawn.depth[3] += 0.001F;
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().kind, records::AttributeKind::depth);
}

TEST(EqualW, FindsAQuotientThatIsAnother) {
  const Check forgotten = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_general(c)) value(drawn, 0, 1, 1, 4) *= 1.0001F;
  });
  ASSERT_EQ(forgotten.violation_count, 1U);
  EXPECT_EQ(forgotten.violations.front().kind, records::AttributeKind::smooth);
  EXPECT_THAT(forgotten.violations.front().exact, HasSubstr("the quotient"));
  const Check nothing = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_general(c)) value(drawn, 0, 1, 1, 3) = std::numeric_limits<float>::quiet_NaN();
  });
  ASSERT_EQ(nothing.violation_count, 1U);
  EXPECT_EQ(nothing.violations.front().fragment_class, records::FragmentClass::not_a_number);
}

// If the contract leaves the placement of vertices open, values may belong to other places.
TEST(EqualW, LeavesWhatIsPlacedAnywhereAlone) {
  const auto off = [](const Case& c, Fragments& drawn) {
    if (is_general(c)) value(drawn, 0, 1, 1, 0) += 1;
  };
  EXPECT_EQ(checked(square(), off, "method:rational-linear").violation_count, 0U);
  EXPECT_EQ(checked(square(), off).violation_count, 1U);
  Case snapped = square();
  snapped.coverage = cases::Snapping{8};
  snapped.basis = cases::Basis::snapped;
  EXPECT_EQ(checked(snapped, off).violation_count, 1U);
}

}  // namespace
}  // namespace rastercheck::properties::equal_w_equals_the_general_path_test
