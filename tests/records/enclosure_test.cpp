#include "records/enclosure.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

namespace rastercheck::records::enclosure_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

TEST(Magnitude, IsOfEitherSideOfZeroAndOfBoth) {
  EXPECT_EQ(magnitude({1, 2}), (Enclosure{1, 2}));
  EXPECT_EQ(magnitude({-2, -1}), (Enclosure{1, 2}));
  EXPECT_EQ(magnitude({-3, 2}), (Enclosure{0, 3}));
  EXPECT_EQ(magnitude({0, 2}), (Enclosure{0, 2}));
}

TEST(Contains, TakesBothEndsAndWhatLiesBetween) {
  const Enclosure enclosure{1, 2};
  EXPECT_TRUE(contains(enclosure, 1));
  EXPECT_TRUE(contains(enclosure, 1.5));
  EXPECT_TRUE(contains(enclosure, 2));
}

TEST(Contains, RefusesTheNeighboursOfTheEnds) {
  const Enclosure enclosure{1, 2};
  EXPECT_FALSE(contains(enclosure, std::nextafter(1.0, 0.0)));
  EXPECT_FALSE(contains(enclosure, std::nextafter(2.0, 3.0)));
}

TEST(Contains, AnEnclosureOfOnePointHoldsThatPointAlone) {
  const Enclosure enclosure{0.1, 0.1};
  EXPECT_TRUE(contains(enclosure, 0.1));
  EXPECT_FALSE(contains(enclosure, std::nextafter(0.1, 1.0)));
  EXPECT_FALSE(contains(enclosure, std::nextafter(0.1, 0.0)));
}

TEST(Contains, DoesNotTellTheZerosApart) {
  EXPECT_TRUE(contains({0.0, 0.0}, -0.0));
  EXPECT_TRUE(contains({-0.0, -0.0}, 0.0));
}

TEST(Contains, AnInfiniteEndBoundsNothing) {
  EXPECT_TRUE(contains({-kInfinity, kInfinity}, kMax));
  EXPECT_TRUE(contains({-kInfinity, kInfinity}, -kMax));
  EXPECT_TRUE(contains({-kInfinity, 0}, -kMax));
  EXPECT_FALSE(contains({-kInfinity, 0}, kLeast));
  EXPECT_FALSE(contains({0, kInfinity}, -kLeast));
}

TEST(Contains, NotANumberLiesInNoEnclosure) {
  EXPECT_FALSE(contains({-kInfinity, kInfinity}, std::numeric_limits<double>::quiet_NaN()));
}

TEST(CertainDecimal, IsNothingWithoutACertainDigit) {
  EXPECT_EQ(certain_decimal({0.123411, 0.123491}, 6), "0.123");
  EXPECT_EQ(certain_decimal({1, 2}, 6), std::nullopt);
  EXPECT_EQ(certain_decimal({-kLeast, kLeast}, 6), std::nullopt);
  EXPECT_EQ(certain_decimal({-0.0, 0}, 6), "0");
}

TEST(ToDecimal, EqualEndsGiveAllDigitsAskedFor) {
  EXPECT_EQ(to_decimal({0.1, 0.1}, 17), "0.10000000000000001");
  EXPECT_EQ(to_decimal({0.1, 0.1}, 5), "0.1");
  EXPECT_EQ(to_decimal({-2.5, -2.5}, 17), "-2.5");
  EXPECT_EQ(to_decimal({0, 0}, 17), "0");
  EXPECT_EQ(to_decimal({1234567, 1234567}, 3), "1.23e+06");
}

TEST(ToDecimal, TheNumberIsRoundedNotCut) {
  EXPECT_EQ(to_decimal({1.0 / 3, 1.0 / 3}, 3), "0.333");
  EXPECT_EQ(to_decimal({2.0 / 3, 2.0 / 3}, 3), "0.667");
}

TEST(ToDecimal, EndsThatDifferInALateDigitGiveTheDigitsBeforeIt) {
  EXPECT_EQ(to_decimal({1.234561, 1.234569}, 17), "1.2346");
  EXPECT_EQ(to_decimal({1.234561, 1.234564}, 17), "1.23456");
  EXPECT_EQ(to_decimal({-1.234569, -1.234561}, 17), "-1.2346");
}

TEST(ToDecimal, EndsOnBothSidesOfACarryAgreeAfterRounding) {
  EXPECT_EQ(to_decimal({0.99999, 1.00001}, 17), "1");
}

TEST(ToDecimal, MoreDigitsThanAskedForAreNotGiven) {
  EXPECT_EQ(to_decimal({1.234561, 1.234564}, 2), "1.2");
}

TEST(ToDecimal, EndsThatShareNoDigitAreBothGiven) {
  EXPECT_EQ(to_decimal({1, 2}, 17), "[1, 2]");
  EXPECT_EQ(to_decimal({-0.5, 0.5}, 6), "[-0.5, 0.5]");
  EXPECT_EQ(to_decimal({1, 1000}, 6), "[1, 1000]");
  EXPECT_EQ(to_decimal({0, kLeast}, 6), "[0, 4.9406564584124654e-324]");
}

TEST(ToDecimal, NoDigitAskedForGivesTheEnds) { EXPECT_EQ(to_decimal({1, 1}, 0), "[1, 1]"); }

TEST(ToDecimal, AnInfiniteEndIsShownAsSuch) {
  EXPECT_EQ(to_decimal({-kInfinity, kInfinity}, 17), "[-inf, inf]");
  EXPECT_EQ(to_decimal({1, kInfinity}, 17), "[1, inf]");
  EXPECT_EQ(to_decimal({kMax, kInfinity}, 17), "[1.7976931348623157e+308, inf]");
  EXPECT_EQ(to_decimal({-kInfinity, -1}, 17), "[-inf, -1]");
}

// Kills: comparing the texts of the ends, which differ for the two zeros although the number does
// not.
TEST(ToDecimal, ZerosOfBothSignsEncloseZeroAlone) { EXPECT_EQ(to_decimal({-0.0, 0.0}, 17), "0"); }

std::string printed(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

// Kills: cutting digits off instead of rounding; one digit too many; one too few.
RC_GTEST_PROP(ToDecimal, GivesTheMostDigitsThatEveryNumberBetweenTheEndsRoundsTo, ()) {
  const auto mantissa = *rc::gen::inRange<std::int64_t>(1, std::int64_t{1} << 52);
  const auto exponent = *rc::gen::inRange(-80, 80);
  const auto width_bits = *rc::gen::inRange(0, 52);
  const auto digits = *rc::gen::inRange(1, 18);
  const bool negative = *rc::gen::arbitrary<bool>();
  const std::int64_t width = (std::int64_t{1} << width_bits) - 1;
  const std::int64_t half_width = width / 2;
  const double lo = std::ldexp(static_cast<double>(mantissa), exponent);
  const double middle = std::ldexp(static_cast<double>(mantissa + half_width), exponent);
  const double hi = std::ldexp(static_cast<double>(mantissa + width), exponent);
  const std::string text = negative ? to_decimal({-hi, -lo}, digits) : to_decimal({lo, hi}, digits);

  int most = 0;  // digits on which both ends agree
  for (int n = 1; n <= digits; ++n) {
    if (printed(lo, n) == printed(hi, n)) most = n;
  }
  RC_ASSERT(text.starts_with('[') == (most == 0));
  if (most == 0) return;
  RC_ASSERT(text == (negative ? "-" : "") + printed(middle, most));
}

}  // namespace
}  // namespace rastercheck::records::enclosure_test
