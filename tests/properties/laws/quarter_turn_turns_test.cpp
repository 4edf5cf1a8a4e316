// The law catches drawings that are right one way up and wrong after a turn, names places in the
// original case, and ignores ties and cases that cannot be turned.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"
#include "tests/properties/laws/own_cases.h"

namespace rastercheck::properties::quarter_turn_turns_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "a-quarter-turn-turns-the-picture";

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// The square's triangle A in 12×8 pixels: wider than high, so that exchanged sides show, and
/// without ties.
Case wide() {
  Case c = square();
  c.framebuffer = {12, 8, 1};
  c.viewport = {0.25F, -0.125F, 11.5F, 8.25F, 0, 1};
  c.triangles.pop_back();
  return c;
}

TEST(QuarterTurn, TurnsUnderAllRules) {
  for (const cases::Rules rules : {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
    for (const int samples : {1, 4}) {
      for (const cases::Cull cull : {cases::Cull::none, cases::Cull::front, cases::Cull::back}) {
        Case c = wide();
        c.rules = rules;
        c.framebuffer.samples = samples;
        c.cull = cull;
        c.scissor = cases::Scissor{1, 2, 7, 5};
        const Check check = checked(c, {});
        EXPECT_TRUE(check.is_applicable);
        EXPECT_EQ(check.violation_count, 0U);
        // Under Vulkan, clip y points down like window y, so the triangle is clockwise on the
        // screen.
        const bool is_kept = (rules == cases::Rules::vulkan) == (cull == cases::Cull::front);
        if (cull == cases::Cull::none || is_kept) {
          EXPECT_GT(check.judgement.counts.required, 20U) << samples;
        }
      }
    }
  }
}

TEST(QuarterTurn, DrawsTheTurnedCase) {
  Case seen;
  checked(wide(), [&seen](const Case& c, Fragments&) { seen = c; });
  EXPECT_EQ(seen.framebuffer, (cases::FramebufferSize{8, 12, 1}));
  EXPECT_EQ(seen.viewport, (cases::Viewport{-0.125F, 0.25F, 8.25F, 11.5F, 0, 1}));
  EXPECT_EQ(seen.positions[1], (cases::ClipVertex{1, 1, 0.25F, 1}));
}

TEST(QuarterTurn, HasNoNegativeWidth) {
  Case c = wide();
  c.viewport.y += c.viewport.height;
  c.viewport.height = -c.viewport.height;
  Case seen;
  const Check check = checked(c, [&seen](const Case& turned, Fragments&) { seen = turned; });
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_GT(check.judgement.counts.required, 20U);
  EXPECT_GT(seen.viewport.width, 0);
}

// Pixel (i, j) = (1, 3) of the case is pixel (8 − 1 − 3, 1) of the turned case.
TEST(QuarterTurn, FindsWhatIsMissingInThePlaceOfTheCaseAsItWas) {
  const Check check = checked(wide(), [](const Case&, Fragments& drawn) { drop(drawn, 0, 4, 1); });
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::missing);
  EXPECT_EQ(violation.place.x, 1U);
  EXPECT_EQ(violation.place.y, 3U);
  EXPECT_EQ(violation.note, "drawn turned by a quarter, at pixel (4, 1)");
}

TEST(QuarterTurn, FindsValuesOfAnotherPlaceAndFragmentsOfNone) {
  const Check check = checked(wide(), [](const Case&, Fragments& drawn) {
    value(drawn, 0, 4, 1, 0) += 0.001F;
    add(drawn, 0, 8, 0);
    add(drawn, 0, 0, 12);
  });
  EXPECT_EQ(check.violation_count, 3U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("turned by a quarter"));
}

// The triangle owns the samples on its diagonal in one orientation but not in the other.
TEST(QuarterTurn, LeavesTiesAlone) {
  Case c = square();
  c.viewport = {0.5F, 0, 8, 8.25F, 0, 1};
  c.triangles = {{0, 1, 2}};
  const Check check = checked(c, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Contains("tie"));
}

TEST(QuarterTurn, SaysNothingOfWhatDoesNotTurn) {
  const auto is_applicable = [](const Case& c) { return checked(c, {}).is_applicable; };
  EXPECT_TRUE(is_applicable(wide()));
  Case pattern = wide();
  pattern.framebuffer.samples = 8;
  EXPECT_FALSE(is_applicable(pattern));
  Case no_float = wide();
  no_float.viewport.y = 0x1p-30F;
  EXPECT_FALSE(is_applicable(no_float));
  Case border = wide();  // its side runs through the sample centres of row 0
  border.viewport.y = 0.5F;
  border.viewport.height = 7.25F;
  EXPECT_FALSE(is_applicable(border));
  border.viewport.height = -7.25F;
  EXPECT_FALSE(is_applicable(border));
}

TEST(QuarterTurn, TurnsRoundingOnGridsThatTurn) {
  Case c = wide();
  c.framebuffer.height = 7;
  c.coverage = cases::Snapping{8};
  DamagedBackend backend({}, "cpu");
  cases::Contract contract = backend.contract(c);
  const auto is_applicable = [&](int bits, cases::Rounding rounding) {
    contract.coverage = cases::Snapping{bits, rounding};
    backend.promised = contract;
    return check_of(kLaw, c, backend).is_applicable;
  };
  EXPECT_TRUE(is_applicable(8, cases::Rounding::nearest_even));
  EXPECT_TRUE(is_applicable(8, cases::Rounding::unspecified));
  EXPECT_FALSE(is_applicable(8, cases::Rounding::half_up));
  EXPECT_FALSE(is_applicable(0, cases::Rounding::nearest_even));
}

TEST(QuarterTurn, OfTheLawsOwnCasesMeetsAllSorts) {
  const FoundInOwnCases found = check_own_cases(kLaw, "cpu", 200);
  EXPECT_GT(found.applicable, 160);
  EXPECT_THAT(found.labels(),
              testing::IsSupersetOf({"clipped", "permitted", "several samples", "tie", "w <= 0"}));
}

}  // namespace
}  // namespace rastercheck::properties::quarter_turn_turns_test
