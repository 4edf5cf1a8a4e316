// The law catches fragments that are lost or drawn twice, and sums that are not counts; it accepts
// permitted samples, and does not apply to backends without pictures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "properties/law.h"
#include "tests/properties/laws/own_cases.h"
#include "tests/properties/laws/picture_backend.h"

namespace rastercheck::properties::additive_counts_overdraw_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;

constexpr std::string_view kLaw = "additive-blending-counts-overdraw";

TEST(Overdraw, IsOfBackendsThatDrawPictures) {
  PictureBackend backend;
  EXPECT_TRUE(is_promised(*find_law(kLaw), backend));
  EXPECT_TRUE(check_of(kLaw, square(), backend).is_applicable);
  DamagedBackend none;
  EXPECT_FALSE(is_promised(*find_law(kLaw), none));
  EXPECT_FALSE(check_of(kLaw, square(), none).is_applicable);
}

TEST(Overdraw, IsCountedByTheModelAndMet) {
  PictureBackend backend;
  const FoundInOwnCases found = check_own_cases(kLaw, backend, 200);
  EXPECT_EQ(found.violated, 0);
  EXPECT_GT(found.required, 12000U);
  EXPECT_THAT(found.labels(), testing::IsSupersetOf({"clipped", "much overdraw", "overdraw",
                                                     "permitted", "several samples", "w <= 0"}));
}

TEST(Overdraw, CountsTheSquareOnce) {
  PictureBackend backend;
  const Check check = check_of(kLaw, square(), backend);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 64U);
}

TEST(Overdraw, FindsWhatIsLostAndWhatIsDrawnTwice) {
  PictureBackend backend;
  backend.fragment_damage = [](const Case&, Fragments& drawn) {
    drop(drawn, 0, 1, 1);
    const std::size_t at = find(drawn, 1, 6, 6);
    drawn.x[at] = 5;  // triangle 1 already covers this pixel
  };
  const Check check = check_of(kLaw, square(), backend);
  ASSERT_EQ(check.violation_count, 3U);
  const records::Violation& lost = check.violations[0];
  EXPECT_EQ(lost.fragment_class, FragmentClass::missing);
  EXPECT_EQ(lost.place.x, 1U);
  EXPECT_EQ(lost.place.y, 1U);
  EXPECT_EQ(lost.exact, "1 required, 0 permitted");
  EXPECT_EQ(lost.actual, "0 (0x0p+0)");
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::extra);
  EXPECT_EQ(check.violations[1].place.x, 5U);
  EXPECT_EQ(check.violations[1].place.triangle, 1U);
  EXPECT_EQ(check.violations[2].fragment_class, FragmentClass::missing);
}

TEST(Overdraw, FindsWhatIsNoCount) {
  PictureBackend backend;
  backend.picture_damage = [](const cases::Pipeline&, cases::Picture& picture) {
    picture.color[0] = 0.5F;
    picture.color[1] = std::numeric_limits<float>::infinity();
  };
  const Check check = check_of(kLaw, square(), backend);
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::infinite);
}

// The diagonal's samples are permitted for both triangles: one, both or none of them may draw each
// sample.
TEST(Overdraw, LetsPermittedSamplesBe) {
  PictureBackend backend("method:rational-linear");
  backend.fragment_damage = [](const Case&, Fragments& drawn) {
    drop(drawn, 1, 3, 4);
    add(drawn, 0, 4, 3);
    value(drawn, 0, 4, 3, 0) = 1;
  };
  const Check check = check_of(kLaw, square(), backend);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.permitted, 16U);
}

}  // namespace
}  // namespace rastercheck::properties::additive_counts_overdraw_test
