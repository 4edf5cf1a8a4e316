// The law catches a triangle without area that loses a pixel with one of its vertices.

#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::degenerate_covers_its_pixels_test {
namespace {

using cases::Case;
using cases::Fragments;

constexpr std::string_view kLaw = "triangles-without-area-cover-their-pixels-if-promised";
constexpr const char* kOuter = "cpu:conservative=outer";

/// The square's corners moved onto one line, from (1.5, 2.5) to (5.5, 2.5) by way of (3.5, 2.5).
Case segment() {
  Case c = square();
  c.positions = {{-0.625F, -0.375F, 0.25F, 1},
                 {-0.125F, -0.375F, 0.25F, 1},
                 {0.375F, -0.375F, 0.25F, 1},
                 {1, 1, 0.25F, 1}};
  c.triangles = {{0, 1, 2}};
  return c;
}

TEST(DegenerateCovers, ThePixelsOfItsVertices) {
  const Check check = check_of(kLaw, segment(), Damage(), kOuter);
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.judgement.counts.required, 3U);
  EXPECT_EQ(check.violation_count, 0U);
}

TEST(DegenerateCovers, AndIsCaughtWithoutOne) {
  const Check check = check_of(
      kLaw, segment(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 3, 2); }, kOuter);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, records::FragmentClass::missing);
}

TEST(DegenerateCovers, NothingIsPromisedOfEqualIndicesOrCulling) {
  Case c = segment();
  c.triangles = {{0, 0, 2}};
  EXPECT_FALSE(check_of(kLaw, c, Damage(), kOuter).is_applicable);
  c = segment();
  c.cull = cases::Cull::front;
  EXPECT_FALSE(check_of(kLaw, c, Damage(), kOuter).is_applicable);
  EXPECT_FALSE(check_of(kLaw, segment(), Damage(), "cpu:conservative=inner").is_applicable);
}

// Kills: a generator whose triangles have an area, or lie beyond the window.
TEST(DegenerateCovers, NearlyAllOwnCasesAreChecked) {
  const FoundInOwnCases found = check_own_cases(kLaw, kOuter, 100);
  EXPECT_GE(found.applicable, 70);
  EXPECT_EQ(found.violated, 0);
  EXPECT_EQ(found.strata, (std::set<std::string>{"a segment", "points", "segments"}));
}

}  // namespace
}  // namespace rastercheck::properties::degenerate_covers_its_pixels_test
