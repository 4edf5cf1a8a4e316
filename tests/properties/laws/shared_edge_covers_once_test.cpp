// The law catches samples that both triangles of a pair draw, or that neither draws; it does not
// apply to pairs that its promise leaves out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"
#include "tests/properties/laws/violations.h"

namespace rastercheck::properties::shared_edge_covers_once_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::AttributeKind;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "a-shared-edge-covers-each-sample-once";

// (3, 4) lies on the diagonal, and triangle 1 draws it.
TEST(SharedEdge, FindsASampleDrawnByNeither) {
  const Check check =
      check_of(kLaw, square(), [](const Case&, Fragments& drawn) { drop(drawn, 1, 3, 4); });
  expect_at(only(check), FragmentClass::missing, AttributeKind::coverage, 0, 3, 4);
  EXPECT_THAT(only(check).note, HasSubstr("neither triangle 0 nor 1 draws it"));
  EXPECT_THAT(only(check).note, HasSubstr("vertices 2 and 1"));
}

TEST(SharedEdge, FindsASampleDrawnByBoth) {
  const Check check =
      check_of(kLaw, square(), [](const Case&, Fragments& drawn) { add(drawn, 0, 3, 4); });
  expect_at(only(check), FragmentClass::extra, AttributeKind::coverage, 1, 3, 4);
  EXPECT_THAT(only(check).note, HasSubstr("triangle 0 draws it as well"));
}

// Under a contract without a tie rule, the backend may give the sample to either triangle.
TEST(SharedEdge, LetsTheOtherTriangleHaveIt) {
  const Check check = check_of(kLaw, square(), [](const Case&, Fragments& drawn) {
    drop(drawn, 1, 3, 4);
    add(drawn, 0, 3, 4);
  });
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 56U);  // all but the diagonal's
}

TEST(SharedEdge, JudgesTrianglesAloneUnderADepthTest) {
  Case c = square();
  c.depth_test = cases::DepthTest::less;
  c.positions.insert(c.positions.end(), {{-3, -3, 0, 1}, {3, -3, 0, 1}, {-3, 3, 0, 1}});
  c.attribute_values.resize(c.positions.size() * 3);
  c.triangles.push_back({4, 5, 6});
  EXPECT_EQ(check_of(kLaw, c, {}).violation_count, 0U);
}

TEST(SharedEdge, SaysNothingOfPairsThatItsPromiseLeavesOut) {
  const auto is_applicable = [](const Case& c) { return check_of(kLaw, c, {}).is_applicable; };
  EXPECT_TRUE(is_applicable(square()));
  Case alone = square();
  alone.triangles.pop_back();
  EXPECT_FALSE(is_applicable(alone));
  Case same_direction = square();
  same_direction.triangles[1] = {1, 2, 3};
  EXPECT_FALSE(is_applicable(same_direction));
  Case folded = square();
  folded.positions[3] = {-0.75F, -0.5F, 0.25F, 1};
  EXPECT_FALSE(is_applicable(folded));
  Case concave = square();  // vertex 1 lies inside, beyond the other diagonal
  concave.positions[1] = {-0.9F, 0.8F, 0.25F, 1};
  EXPECT_FALSE(is_applicable(concave));
  Case clipped = square();
  clipped.positions[0].z = -0.25F;
  EXPECT_FALSE(is_applicable(clipped));
  Case behind = square();
  behind.positions[0].w = -1;
  EXPECT_FALSE(is_applicable(behind));
  Case cut = square();
  cut.clip_distance_count = 1;
  cut.clip_distances = {1, 1, 0, 1};
  EXPECT_FALSE(is_applicable(cut));
  cut.clip_distances = {1, 1, 0.5F, 1};
  EXPECT_TRUE(is_applicable(cut));
}

TEST(SharedEdge, MeetsTiesWithDifferentWeightsAndSamples) {
  const FoundInOwnCases found = check_own_cases(kLaw, "method:rational-linear", 100);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf({"different w", "permitted", "several samples"}));
  EXPECT_THAT(found.strata, testing::ElementsAre("fans off grid", "fans on grid", "meshes off grid",
                                                 "meshes on grid", "quads through samples"));
}

}  // namespace
}  // namespace rastercheck::properties::shared_edge_covers_once_test
