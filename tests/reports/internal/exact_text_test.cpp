#include "reports/internal/exact_text.h"

#include <gtest/gtest.h>

namespace rastercheck::reports::exact_text_test {
namespace {

void expect_range(const std::string& text, double lo, double hi) {
  const auto numbers = numbers_in(text);
  ASSERT_TRUE(numbers) << text;
  EXPECT_EQ(numbers->lo, lo) << text;
  EXPECT_EQ(numbers->hi, hi) << text;
}

TEST(NumbersIn, ReadsExactAndObservedValues) {
  expect_range("1/4", 0.25, 0.25);
  expect_range("-3", -3, -3);
  expect_range("[-1/2, 3/4]", -0.5, 0.75);
  expect_range("0.5 (0x1p-1)", 0.5, 0.5);
  expect_range("-0.5 (-0x1p-1)", -0.5, -0.5);
}

// Kills: half a number taken for a whole one; infinity taken for a number.
TEST(NumbersIn, RefusesAllElse) {
  for (const std::string text : {"", "nan", "inf", "1/0", "1/", "required: inside", "12…34", "1 2",
                                 "[1/2", "[1/2, nan]", "[12…3, 4]", "1/2 (0x", "4 fragments"}) {
    EXPECT_FALSE(numbers_in(text)) << text;
  }
  EXPECT_FALSE(numbers_in("1" + std::string(400, '0') + "/3"));
}

TEST(ExactText, AddsDecimalsToFractions) {
  EXPECT_EQ(exact_text("1/3"), "1/3 (about 0.333333333)");
  EXPECT_EQ(exact_text("[1/3, 1]"), "[1/3, 1] (about 0.333333333 to 1)");
  EXPECT_EQ(exact_text("7"), "7");
  EXPECT_EQ(exact_text("nan"), "nan");
}

}  // namespace
}  // namespace rastercheck::reports::exact_text_test
