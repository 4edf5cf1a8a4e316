// The law catches a fragment outside the viewport or the scissor, and anything that a picture has
// there; it accepts the far border if the rules leave it open.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "properties/law.h"
#include "tests/properties/laws/picture_backend.h"

namespace rastercheck::properties::nothing_outside_viewport_and_scissor_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "nothing-is-written-outside-viewport-and-scissor";

/// The square in a viewport of columns 1 to 4 and rows 2 to 6 of 8×8 pixels.
Case inset() {
  Case c = square();
  c.viewport = {1, 2, 4, 5, 0, 1};
  return c;
}

/// Checks a case with one additional fragment at a pixel.
Check with_fragment(const Case& c, int x, int y) {
  return check_of(kLaw, c, [=](const Case&, Fragments& drawn) { add(drawn, 0, x, y); });
}

TEST(Outside, NothingIsWritten) {
  Case c = inset();
  c.scissor = cases::Scissor{2, 0, 100, 8};
  PictureBackend backend;
  const Check check = check_of(kLaw, c, backend);
  EXPECT_TRUE(check.is_applicable);
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 15U);
  EXPECT_THAT(check.labels, testing::ElementsAre("drawn", "outside the viewport", "scissor"));
}

TEST(Outside, FindsFragmentsBeyondEachSideOfTheViewport) {
  for (const auto& [x, y] : {std::pair{0, 3}, {5, 3}, {3, 1}, {3, 7}}) {
    const Check check = with_fragment(inset(), x, y);
    ASSERT_EQ(check.violation_count, 1U) << x << y;
    const records::Violation& violation = check.violations.front();
    EXPECT_EQ(violation.fragment_class, FragmentClass::extra);
    EXPECT_EQ(violation.exact, "forbidden: outside the viewport");
    EXPECT_EQ(violation.place.x, static_cast<std::uint32_t>(x));
    EXPECT_EQ(violation.place.y, static_cast<std::uint32_t>(y));
  }
}

TEST(Outside, FindsFragmentsOfAViewportTurnedRound) {
  Case c = inset();
  c.viewport = {5, 7, -4, -5, 0, 1};
  EXPECT_EQ(check_of(kLaw, c, {}).violation_count, 0U);
  EXPECT_EQ(with_fragment(c, 5, 3).violation_count, 1U);
  EXPECT_EQ(with_fragment(c, 0, 3).violation_count, 1U);
  EXPECT_EQ(with_fragment(c, 3, 7).violation_count, 1U);
}

// The centres of column 5 lie on the far border, and those of column 1 on the near border.
TEST(Outside, LeavesTheFarBorderToTheRules) {
  for (const float width : {4.0F, -4.0F}) {
    Case c = inset();
    c.viewport.x = width < 0 ? 5.5F : 1.5F;
    c.viewport.width = width;
    for (const cases::Rules rules :
         {cases::Rules::opengl, cases::Rules::vulkan, cases::Rules::d3d}) {
      c.rules = rules;
      EXPECT_EQ(with_fragment(c, 5, 3).violation_count, rules == cases::Rules::d3d ? 1U : 0U);
      EXPECT_EQ(with_fragment(c, 0, 3).violation_count, 1U);
      EXPECT_EQ(with_fragment(c, 6, 3).violation_count, 1U);
    }
  }
}

// The far border is at 4.5 ± 2^-60, which no double can hold.
TEST(Outside, KnowsBordersThatNoDoubleHas) {
  Case c = inset();
  c.rules = cases::Rules::d3d;
  c.viewport.x = -0x1p-60F;
  c.viewport.width = 4.5F;
  EXPECT_EQ(with_fragment(c, 4, 3).violation_count, 1U);
  c.viewport.x = 0x1p-60F;
  EXPECT_EQ(with_fragment(c, 4, 3).violation_count, 0U);
}

TEST(Outside, FindsFragmentsBeyondTheScissor) {
  Case c = square();
  c.scissor = cases::Scissor{2, 3, 3, std::numeric_limits<int>::max()};
  EXPECT_EQ(check_of(kLaw, c, {}).violation_count, 0U);
  for (const auto& [x, y] : {std::pair{1, 5}, {5, 5}, {3, 2}}) {
    const Check check = with_fragment(c, x, y);
    ASSERT_EQ(check.violation_count, 1U);
    EXPECT_EQ(check.violations.front().exact, "forbidden: outside the scissor");
  }
  c.scissor = cases::Scissor{2, 3, 0, 2};
  EXPECT_THAT(check_of(kLaw, c, {}).labels, testing::ElementsAre("scissor without area"));
  EXPECT_EQ(with_fragment(c, 2, 3).violation_count, 1U);
}

TEST(Outside, FindsFragmentsOfNoPixel) {
  EXPECT_EQ(with_fragment(square(), 8, 0).violations.front().exact,
            "forbidden: outside the target");
}

TEST(Outside, FindsWhatAPictureHasThere) {
  PictureBackend backend;
  backend.picture_damage = [](const cases::Pipeline&, cases::Picture& picture) {
    picture.depth[7] = 0.25F;
    picture.color[picture.channels * 8 + 1] = -0.0F;
    picture.depth[3 * 8 + 3] = 0.125F;  // inside: left to other laws
  };
  const Check check = check_of(kLaw, inset(), backend);
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::extra);
  EXPECT_EQ(check.violations[0].kind, records::AttributeKind::depth);
  EXPECT_EQ(check.violations[0].place.x, 7U);
  EXPECT_EQ(check.violations[1].place.y, 1U);
  EXPECT_THAT(check.violations[1].note, HasSubstr("outside the viewport"));
}

}  // namespace
}  // namespace rastercheck::properties::nothing_outside_viewport_and_scissor_test
