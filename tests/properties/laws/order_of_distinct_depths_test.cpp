// The law catches a depth test that depends on the order of triangles; it ignores equal depths.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::order_of_distinct_depths_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "distinct-depths-are-drawn-in-any-order";

/// Triangle A of the square twice: at depth 1/4 and then at 1/2.
Case layers() {
  Case c = square();
  c.positions.insert(c.positions.end(), {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {-1, 1, 0.5F, 1}});
  c.attribute_values.resize(c.positions.size() * 3);
  c.triangles = {{0, 1, 2}, {4, 5, 6}};
  return c;
}

bool is_reversed(const Case& c) { return c.triangles[0][0] == 4; }

TEST(DistinctDepths, AreDrawnInAnyOrder) {
  const Check check = check_of(kLaw, layers(), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 28U);
  EXPECT_THAT(check.labels, testing::ElementsAre("depth test", "distinct depths"));
}

// The farther triangle remains in the order in which it is drawn last.
TEST(DistinctDepths, FindTheTriangleThatOneOrderLeavesWrongly) {
  const Check check = check_of(kLaw, layers(), [](const Case& c, Fragments& drawn) {
    if (c.depth_test == cases::DepthTest::none || is_reversed(c)) return;
    const std::size_t at = find(drawn, 0, 1, 1);
    drawn.triangle[at] = 1;
    drawn.depth[at] = 0.5F;
  });
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::wrong_triangle);
  EXPECT_EQ(violation.place.triangle, 1U);
  EXPECT_EQ(violation.place.x, 1U);
  EXPECT_EQ(violation.place.y, 1U);
  EXPECT_EQ(violation.exact, "forbidden: triangle 0 is nearer");
  EXPECT_THAT(violation.note, HasSubstr("drawn in submission order, at depth 0.5"));
}

TEST(DistinctDepths, FindWhatOneOrderLosesOrAdds) {
  const Check check = check_of(kLaw, layers(), [](const Case& c, Fragments& drawn) {
    if (c.depth_test == cases::DepthTest::none) return;
    if (is_reversed(c)) {
      drop(drawn, 1, 1, 1);  // the index of the nearer triangle there
    } else {
      drop(drawn, 0, 2, 2);
    }
  });
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations[0].place.x, 1U);
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::extra);
  EXPECT_EQ(check.violations[1].place.x, 2U);
}

TEST(DistinctDepths, FindValuesThatDependOnTheOrder) {
  const Check check = check_of(kLaw, layers(), [](const Case& c, Fragments& drawn) {
    if (c.depth_test == cases::DepthTest::none || !is_reversed(c)) return;
    value(drawn, 1, 2, 3, 1) = std::nextafter(1.0F, 2.0F);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().place.triangle, 0U);
  EXPECT_EQ(check.violations.front().attribute, 1U);
}

TEST(DistinctDepths, LeaveEqualOnesAndThoseThatAreNoNumberAlone) {
  Case c = layers();
  for (std::size_t v = 4; v < 7; ++v) c.positions[v].z = 0.25F;
  const Check equal = check_of(kLaw, c, {});
  EXPECT_EQ(equal.violation_count, 0U);
  EXPECT_THAT(equal.labels, testing::ElementsAre("depth test", "equal depths"));
  const Check none = check_of(kLaw, layers(), [](const Case& with, Fragments& drawn) {
    if (with.depth_test == cases::DepthTest::none || is_reversed(with)) return;
    const std::size_t at = find(drawn, 0, 1, 1);
    drawn.triangle[at] = 1;
    drawn.depth[at] = std::numeric_limits<float>::quiet_NaN();
  });
  EXPECT_EQ(none.violation_count, 0U);
}

TEST(DistinctDepths, TakeTwoTriangles) {
  Case c = layers();
  c.triangles.pop_back();
  EXPECT_FALSE(check_of(kLaw, c, {}).is_applicable);
}

TEST(DistinctDepths, OfTheLawsOwnCasesMeetEachOther) {
  FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_GT(found.reached["distinct depths"], 120);
  EXPECT_THAT(found.labels(), testing::IsSupersetOf({"clipped", "equal depths", "several samples",
                                                     "three and more", "w <= 0"}));
}

}  // namespace
}  // namespace rastercheck::properties::order_of_distinct_depths_test
