// The law catches different depths in one plane, within one triangle and across two. It ignores
// planes that are not parallel to the screen, and samples that should not be drawn.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::equal_depth_stays_equal_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;

constexpr std::string_view kLaw = "equal-depth-stays-equal";

/// The square with a different w at each vertex, still at depth 1/4.
Case tilted() {
  Case c = square();
  constexpr std::array kWeights{1.0F, 2.0F, 3.0F, 0.625F};
  for (std::size_t i = 0; i < 4; ++i) {
    cases::ClipVertex& p = c.positions[i];
    p = {p.x * kWeights[i], p.y * kWeights[i], p.z * kWeights[i], kWeights[i]};
  }
  return c;
}

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

float& depth(Fragments& drawn, std::uint32_t triangle, int x, int y) {
  return drawn.depth[find(drawn, triangle, x, y)];
}

TEST(EqualDepth, HoldsOfTheSquare) {
  const Check check = checked(tilted(), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  EXPECT_THAT(check.labels, testing::ElementsAre("different w", "several triangles"));
}

TEST(EqualDepth, FindsTheNextFloat) {
  const Check check = checked(tilted(), [](const Case&, Fragments& drawn) {
    depth(drawn, 0, 2, 3) = std::nextafter(0.25F, 1.0F);
    depth(drawn, 0, 3, 3) = std::numeric_limits<float>::quiet_NaN();
  });
  ASSERT_EQ(check.violation_count, 2U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(violation.kind, AttributeKind::depth);
  EXPECT_EQ(violation.place.x, 2U);
  EXPECT_EQ(violation.place.y, 3U);
  EXPECT_EQ(violation.note,
            "z/w is the same at all vertices, and the plane's first depth was 0.25 (0x1p-2)");
  EXPECT_EQ(check.violations.back().fragment_class, FragmentClass::not_a_number);
}

// Each triangle has a single depth, but the two depths differ.
TEST(EqualDepth, FindsTwoTrianglesThatDiffer) {
  const Check check = checked(tilted(), [](const Case&, Fragments& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (drawn.triangle[i] == 1) drawn.depth[i] = std::nextafter(0.25F, 1.0F);
    }
  });
  EXPECT_EQ(check.violation_count, 36U);
  EXPECT_EQ(check.violations.front().place.triangle, 1U);
}

TEST(EqualDepth, KnowsPlanesApart) {
  Case c = tilted();
  c.positions.insert(c.positions.end(), {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}});
  c.attribute_values.resize(c.positions.size() * 3);
  c.triangles.push_back({4, 5, 6});
  EXPECT_EQ(checked(c, {}).violation_count, 0U);
}

TEST(EqualDepth, SaysNothingOfSlopesAndOfWhatIsNotPromised) {
  Case slope = square();
  slope.positions[1].z = 0.5F;
  EXPECT_FALSE(checked(slope, {}).is_applicable);
  DamagedBackend backend({}, "cpu");
  cases::Contract contract = backend.contract(square());
  contract.keeps_equal_depth = false;
  backend.promised = contract;
  EXPECT_FALSE(check_of(kLaw, square(), backend).is_applicable);
  EXPECT_FALSE(is_promised(*find_law(kLaw), backend));
}

// A fragment at depth 0 in a pixel that its triangle does not cover.
TEST(EqualDepth, LeavesSamplesThatShouldNotBeThereAlone) {
  const Check check = checked(tilted(), [](const Case&, Fragments& drawn) { add(drawn, 0, 7, 7); });
  EXPECT_EQ(check.violation_count, 0U);
}

}  // namespace
}  // namespace rastercheck::properties::equal_depth_stays_equal_test
