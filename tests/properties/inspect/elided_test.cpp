#include "properties/inspect/elided.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rastercheck::properties::elided_test {
namespace {

using oracle::Rational;

std::size_t digits_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }));
}

TEST(Elided, LeavesShortFractionsAlone) {
  EXPECT_EQ(elided(Rational(-0.375)), "-3/8");
  EXPECT_EQ(elided(Rational(12)), "12");
}

// 2^-700 is 1 over a number with 211 digits, 5260…; 2^1000 has 302 digits, 10715086071…069376.
// Kills: digits left out at an end; a short numerator that loses digits; a lost sign.
TEST(Elided, LeavesOutTheMiddleOfLongOnes) {
  const std::string small = elided(Rational(std::ldexp(-1.0, -700)));
  EXPECT_EQ(small.substr(0, 7), "-1/5260");
  EXPECT_NE(small.find("…"), std::string::npos);
  EXPECT_EQ(digits_of(small), 101U);
  const std::string large = elided(Rational(std::ldexp(-1.0, 1000)));
  EXPECT_EQ(large.substr(0, 12), "-10715086071");
  EXPECT_EQ(large.substr(large.size() - 6), "069376");
  EXPECT_EQ(digits_of(large), 100U);
  // 2^600 has 181 digits.
  EXPECT_EQ(digits_of(elided(Rational(std::ldexp(1.0, 600)))), 181U);
}

TEST(Elided, ShowsBothEndsOfARange) {
  EXPECT_EQ(elided(oracle::ValueRange{Rational(0.5), Rational(0.75), true}), "[1/2, 3/4]");
  EXPECT_EQ(elided(oracle::ValueRange{Rational(0.5), Rational(0.5), true}), "1/2");
}

}  // namespace
}  // namespace rastercheck::properties::elided_test
