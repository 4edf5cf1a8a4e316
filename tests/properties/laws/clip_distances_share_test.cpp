// The law catches samples that a clip distance and its opposite both draw, or neither draws, or
// that are drawn only with a distance. It accepts samples that the rules draw twice, and those that
// a snapped cut leaves open.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::clip_distances_share_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "complementary-clip-distances-share-what-is-drawn";

/// The square, and the distance u − 3.5: zero at the centres of column 3.
Case cut_square() {
  Case c = square();
  c.clip_distance_count = 1;
  c.clip_distances = {-3.5F, 4.5F, -3.5F, 4.5F};
  return c;
}

/// Checks `cpu`, whose contract decides ties.
Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

bool is_opposite(const Case& c) { return c.clip_distance_count > 0 && c.clip_distances[0] > 0; }

TEST(ClipDistances, ShareTheSquare) {
  const Check check = checked(cut_square(), {});
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  EXPECT_THAT(check.labels, testing::ElementsAre("clipped", "shared triangle", "zero at a sample"));
}

TEST(ClipDistances, OfNoneSayNothing) { EXPECT_FALSE(checked(square(), {}).is_applicable); }

// Pixel (3, 1) belongs to A. Its zero belongs to the distance and not to its opposite, because the
// distance's normal points to the right.
TEST(ClipDistances, FindAZeroThatBothDraw) {
  const Check check = checked(cut_square(), [](const Case& c, Fragments& drawn) {
    if (is_opposite(c)) add(drawn, 0, 3, 1);
  });
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::extra);
  EXPECT_EQ(violation.place.triangle, 0U);
  EXPECT_EQ(violation.place.x, 3U);
  EXPECT_EQ(violation.place.y, 1U);
  EXPECT_EQ(violation.note, "clip distance 0: drawn with the distance and with its opposite");
  ASSERT_TRUE(violation.distance.has_value());
  EXPECT_TRUE(records::contains(*violation.distance, 0));
}

TEST(ClipDistances, FindAZeroThatNeitherDraws) {
  const Check check = checked(cut_square(), [](const Case& c, Fragments& drawn) {
    if (c.clip_distance_count > 0 && !is_opposite(c)) drop(drawn, 0, 3, 1);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
  EXPECT_THAT(check.violations.front().note, HasSubstr("drawn with neither"));
}

TEST(ClipDistances, FindWhatOnlyTheyDraw) {
  const Check check = checked(cut_square(), [](const Case& c, Fragments& drawn) {
    if (is_opposite(c)) add(drawn, 0, 1, 7);
    if (c.clip_distance_count == 0) drop(drawn, 1, 7, 7);
  });
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].note, "clip distance 0: drawn with its opposite");
  EXPECT_EQ(check.violations[1].note, "clip distance 0: drawn with it");
  EXPECT_EQ(check.violations[1].exact, "forbidden: it is not drawn without the distance");
}

TEST(ClipDistances, OfD3dDrawTheirZerosTwice) {
  Case c = cut_square();
  c.rules = cases::Rules::d3d;
  const Check check = checked(c, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Contains("drawn with both"));
  const Check once = checked(c, [](const Case& with, Fragments& drawn) {
    if (is_opposite(with)) drop(drawn, find(drawn, 0, 3, 6) < drawn.size() ? 0 : 1, 3, 6);
  });
  ASSERT_EQ(once.violation_count, 1U);
  EXPECT_EQ(once.violations.front().note, "clip distance 0: drawn with the distance only");
}

TEST(ClipDistances, OfZeroEverywhereCutNothing) {
  Case c = cut_square();
  c.clip_distances.assign(4, 0);
  const Check check = checked(c, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Contains("drawn with both"));
}

// Under a contract without a tie rule, either distance may have the zeros, or both may. Samples
// within a grid unit of a snapped cut may be drawn or not.
TEST(ClipDistances, LeaveAloneWhatIsPermitted) {
  const auto twice = [](const Case& c, Fragments& drawn) {
    if (is_opposite(c)) add(drawn, 0, 3, 1);
  };
  EXPECT_EQ(check_of(kLaw, cut_square(), twice).violation_count, 0U);
  Case snapped = cut_square();
  snapped.coverage = cases::Snapping{8};
  const Check check = checked(snapped, twice);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Contains("permitted"));
}

TEST(ClipDistances, OfTheLawsOwnCasesMeetWhatTheyAreAbout) {
  FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_EQ(found.applicable, 200);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf({"clipped", "drawn with both", "permitted", "several samples",
                                     "shared triangle", "w <= 0", "zero at a sample"}));
  EXPECT_GT(found.reached["shared triangle"], 60);
  EXPECT_GT(found.reached["zero at a sample"], 10);
}

}  // namespace
}  // namespace rastercheck::properties::clip_distances_share_test
