// The law catches drawings that are right at one place of the window and wrong at another, names
// pixels in the original case, and moves grids of whole pixels by even numbers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "properties/law.h"
#include "tests/properties/damaged_backend.h"

namespace rastercheck::properties::whole_pixels_move_test {
namespace {

using cases::Case;
using cases::Fragments;
using records::FragmentClass;
using testing::HasSubstr;

constexpr std::string_view kLaw = "whole-pixels-move-the-picture";

Check checked(const Case& c, const Damage& damage) { return check_of(kLaw, c, damage, "cpu"); }

/// The square with a number as attribute 2 of a vertex: another number makes the law choose another
/// move.
Case numbered(int number) {
  Case c = square();
  c.attribute_values[2] = static_cast<float>(number);
  return c;
}

/// The cases that the backend has to draw: the original and the moved one.
std::vector<Case> asked(const Case& c) {
  std::vector<Case> seen;
  checked(c, [&seen](const Case& drawn, Fragments&) { seen.push_back(drawn); });
  return seen;
}

bool is_moved(const Case& c) { return c.viewport != square().viewport; }

TEST(WholePixels, MoveViewportAndScissorAlike) {
  std::set<std::pair<float, float>> moves;
  for (int number = 0; number < 64; ++number) {
    const std::vector<Case> seen = asked(numbered(number));
    ASSERT_EQ(seen.size(), 2U);
    const Case& before = seen[0];
    const Case& after = seen[1];
    const float du = after.viewport.x;
    const float dv = after.viewport.y;
    EXPECT_TRUE(du != 0 || dv != 0);
    EXPECT_EQ(du, std::floor(du));
    EXPECT_EQ(dv, std::floor(dv));
    moves.emplace(du, dv);
    EXPECT_EQ(before.viewport, square().viewport);
    EXPECT_EQ(after.positions, before.positions);
    EXPECT_EQ(after.framebuffer.width, 8 + std::max(static_cast<int>(du), 0));
    EXPECT_EQ(after.framebuffer.height, 8 + std::max(static_cast<int>(dv), 0));
    EXPECT_EQ(before.scissor->x, std::max(-static_cast<int>(du), 0));
    EXPECT_EQ(before.scissor->x + before.scissor->width, 8);
    EXPECT_EQ(after.scissor->x, before.scissor->x + static_cast<int>(du));
    EXPECT_EQ(after.scissor->y, before.scissor->y + static_cast<int>(dv));
    EXPECT_EQ(after.scissor->width, before.scissor->width);
    EXPECT_EQ(after.scissor->height, before.scissor->height);
  }
  EXPECT_GT(moves.size(), 30U);
}

TEST(WholePixels, MoveTheSquare) {
  for (int number = 0; number < 16; ++number) {
    const Check check = checked(numbered(number), {});
    EXPECT_TRUE(check.is_applicable);
    EXPECT_EQ(check.violation_count, 0U);
    EXPECT_GE(check.judgement.counts.required, 16U);  // ties go to the same triangle
  }
}

TEST(WholePixels, FindWhatIsMissingInThePlaceOfTheCaseAsItWas) {
  int du = 0;
  int dv = 0;
  const Check check = checked(square(), [&](const Case& c, Fragments& drawn) {
    if (!is_moved(c)) return;
    du = static_cast<int>(c.viewport.x);
    dv = static_cast<int>(c.viewport.y);
    drop(drawn, 1, 7 + du, 6 + dv);
  });
  ASSERT_EQ(check.violation_count, 1U);
  const records::Violation& violation = check.violations.front();
  EXPECT_EQ(violation.fragment_class, FragmentClass::missing);
  EXPECT_EQ(violation.place.x, 7U);
  EXPECT_EQ(violation.place.y, 6U);
  EXPECT_EQ(violation.note, "drawn " + std::to_string(du) + " columns and " + std::to_string(dv) +
                                " rows further on");
}

// A sample on the diagonal belongs to B, wherever the picture is.
TEST(WholePixels, FindTiesThatGoElsewhere) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (!is_moved(c)) return;
    const auto x = 4 + static_cast<int>(c.viewport.x);
    const auto y = 3 + static_cast<int>(c.viewport.y);
    drawn.triangle[find(drawn, 1, x, y)] = 0;
  });
  ASSERT_EQ(check.violation_count, 2U);
  EXPECT_THAT(check.labels, testing::Contains("tie"));
}

TEST(WholePixels, FindFragmentsOfNoPixel) {
  const Check check = checked(square(), [](const Case& c, Fragments& drawn) {
    if (is_moved(c)) add(drawn, 0, c.framebuffer.width, 0);
  });
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::extra);
}

// Window x of sample (5, 5) is 5.5, and the neighbouring floats are half an ulp of 8 away.
TEST(WholePixels, JudgeValuesThatDifferByTheContract) {
  const auto off_by = [](int floats) {
    return checked(square(), [floats](const Case& c, Fragments& drawn) {
      if (!is_moved(c)) return;
      const auto x = 5 + static_cast<int>(c.viewport.x);
      const auto y = 5 + static_cast<int>(c.viewport.y);
      float& attribute = value(drawn, 1, x, y, 0);
      for (int i = 0; i < floats; ++i) attribute = std::nextafter(attribute, 8.0F);
    });
  };
  EXPECT_EQ(off_by(1).violation_count, 0U);
  const Check check = off_by(2);
  ASSERT_EQ(check.violation_count, 1U);
  EXPECT_EQ(check.violations.front().fragment_class, FragmentClass::beyond_bound);
  EXPECT_EQ(check.violations.front().attribute, 0U);
  EXPECT_THAT(check.violations.front().note, HasSubstr("rows further on"));
}

TEST(WholePixels, MoveGridsOfWholePixelsByEvenNumbers) {
  for (int number = 0; number < 32; ++number) {
    Case c = numbered(number);
    c.coverage = cases::Snapping{0};
    for (const Case& drawn : asked(c)) {
      EXPECT_EQ(std::fmod(drawn.viewport.x, 2.0F), 0);
      EXPECT_EQ(std::fmod(drawn.viewport.y, 2.0F), 0);
    }
  }
}

TEST(WholePixels, SayNothingOfMovesThatAreRounded) {
  Case c = square();
  c.viewport.x = 0x1p-30F;
  c.viewport.y = 0x1p-30F;
  EXPECT_FALSE(checked(c, {}).is_applicable);
}

}  // namespace
}  // namespace rastercheck::properties::whole_pixels_move_test
