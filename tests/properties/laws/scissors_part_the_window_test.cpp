// The law catches a scissor with an inclusive end, a scissor that leaves something out, and values
// that depend on the scissor, to the bit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::scissors_part_the_window_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "scissors-that-part-the-window-part-what-is-drawn";

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage); }

bool is_part(const Case& c) { return c.scissor->width < 8 || c.scissor->height < 8; }

TEST(Scissors, PartTheSquareIntoFour) {
  std::vector<cases::Scissor> asked;
  const Check check =
      checked(square(), [&](const Case& c, Fragments&) { asked.push_back(c.scissor.value()); });
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 64U);
  EXPECT_THAT(check.labels, testing::ElementsAre("parted"));
  ASSERT_EQ(asked.size(), 5U);
  EXPECT_EQ(asked[0], (cases::Scissor{0, 0, 8, 8}));
  const cases::Scissor& first = asked[1];
  EXPECT_GT(first.width * first.height, 0);
  EXPECT_EQ(asked[2], (cases::Scissor{first.width, 0, 8 - first.width, first.height}));
  EXPECT_EQ(asked[3], (cases::Scissor{0, first.height, first.width, 8 - first.height}));
  EXPECT_EQ(asked[4],
            (cases::Scissor{first.width, first.height, 8 - first.width, 8 - first.height}));
}

// The first part is one column wider than asked for, as if its end were inclusive: this column is
// outside the part and belongs to the other part.
TEST(Scissors, FindAnInclusiveEnd) {
  class Inclusive : public DamagedBackend {
   public:
    Result<Fragments> draw_fragments(const Case& c) override {
      Case wider = c;
      if (c.scissor->x == 0 && is_part(c)) ++wider.scissor->width;
      return DamagedBackend::draw_fragments(wider);
    }
  };
  Inclusive backend;
  const Check check = check_of(kLaw, square(), backend);
  EXPECT_EQ(check.violation_count, 8U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::extra);
  EXPECT_EQ(check.violations.front().exact, "forbidden: outside the scissor");
  EXPECT_THAT(check.violations.front().note, HasSubstr("scissor (0, 0)"));
}

TEST(Scissors, FindWhatNoPartDraws) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_part(c) && find(drawn, 0, 1, 1) < drawn.size()) drop(drawn, 0, 1, 1);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::missing);
  EXPECT_EQ(check.violations.front().note, "not drawn in any part");
}

TEST(Scissors, FindWhatOnlyAPartDraws) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (!is_part(c)) drop(drawn, 0, 1, 1);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().exact, "forbidden: it is not drawn in the whole window");
}

TEST(Scissors, FindTheLastBitOfValuesAndNothingLess) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (!is_part(c)) {
      value(drawn, 1, 7, 6, 1) = std::numeric_limits<float>::quiet_NaN();
      return;
    }
    if (find(drawn, 0, 0, 0) < drawn.size()) {
      value(drawn, 0, 0, 0, 0) = std::nextafter(value(drawn, 0, 0, 0, 0), 1.0F);
    }
    if (find(drawn, 1, 7, 7) < drawn.size()) value(drawn, 1, 7, 7, 2) = -0.0F;
    if (find(drawn, 1, 7, 6) < drawn.size()) {
      value(drawn, 1, 7, 6, 1) = -std::numeric_limits<float>::quiet_NaN();
    }
  });
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_EQ(check.violations[0].fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(check.violations[0].attribute, 0U);
  EXPECT_EQ(check.violations[0].exact, "0.5 (0x1p-1)");
  EXPECT_THAT(check.violations[0].note, HasSubstr("another value than in the whole window"));
  EXPECT_EQ(check.violations[1].fragment_class, FragmentClass::wrong_sign_of_zero);
}

TEST(Scissors, PartTheCasesOwn) {
  Case c = square();
  c.scissor = cases::Scissor{-3, 6, 100, std::numeric_limits<int>::max()};
  const Check check = checked(c, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_EQ(check.judgement.counts.required, 16U);
  EXPECT_THAT(check.labels, testing::ElementsAre("parted", "scissor"));
  c.scissor = cases::Scissor{20, 20, 1, 1};
  EXPECT_EQ(checked(c, {}).violation_count, 0U);
}

TEST(Scissors, PartWhatADepthTestLeaves) {
  Case c = square();
  c.depth_test = cases::DepthTest::less;
  c.triangles.push_back({0, 1, 3});
  const Check check = checked(c, {});
  EXPECT_EQ(check.violation_count, 0U);
  EXPECT_THAT(check.labels, testing::Contains("depth test"));
}

}  // namespace
}  // namespace rastercheck::properties::scissors_part_the_window_test
