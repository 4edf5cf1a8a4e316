// The law catches outer coverage that loses a pixel with a sample of the triangle, inner coverage
// that takes one too many, and pixels that are covered in part.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::conservative_and_ordinary_coverage_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "outer-coverage-holds-the-ordinary-one-and-inner-lies-in-it";
constexpr const char* kOuter = "cpu:conservative=outer";
constexpr const char* kInner = "cpu:conservative=inner";

TEST(ConservativeAndOrdinary, AcceptsTheSquare) {
  for (const char* const backend : {kOuter, kInner}) {
    for (const int samples : {1, 16}) {
      Case c = square();
      c.framebuffer.samples = samples;
      const Check check = check_of(kLaw, c, Damage(), backend);
      EXPECT_TRUE(check.is_applicable);
      EXPECT_EQ(check.violation_count, 0U);
    }
  }
}

TEST(ConservativeAndOrdinary, CatchesALostPixel) {
  const Check check = check_of(
      kLaw, square(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 2, 1); }, kOuter);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::missing);
  EXPECT_THAT(check.violations[0].exact, HasSubstr("the sample lies in the triangle"));
}

// The centre of pixel (3, 4) is on the diagonal and B's: A need not cover it.
TEST(ConservativeAndOrdinary, AcceptsALostPixelWithoutASample) {
  const Check check = check_of(
      kLaw, square(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 3, 4); }, kOuter);
  EXPECT_EQ(check.violation_count, 0U);
}

TEST(ConservativeAndOrdinary, CatchesAPixelThatSticksOut) {
  const auto damage = [](const Case&, Fragments& drawn) { add(drawn, 0, 4, 4); };
  const Check check = check_of(kLaw, square(), damage, kInner);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::extra);
  EXPECT_EQ(check_of(kLaw, square(), damage, kOuter).violation_count, 0U);
}

TEST(ConservativeAndOrdinary, CatchesAPixelInPart) {
  Case c = square();
  c.framebuffer.samples = 4;
  for (const char* const backend : {kOuter, kInner}) {
    const Check check = check_of(
        kLaw, c, [](const Case&, Fragments& drawn) { drop(drawn, 1, 7, 7); }, backend);
    ASSERT_EQ(check.violation_count, 1U);
    EXPECT_THAT(check.violations[0].exact, HasSubstr("another sample"));
  }
}

TEST(ConservativeAndOrdinary, IsNotAboutBackendsThatCoverSamples) {
  EXPECT_FALSE(check_of(kLaw, square(), Damage(), "cpu").is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::conservative_and_ordinary_coverage_test
