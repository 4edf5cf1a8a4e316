#include "cases/float_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace rastercheck::cases::float_text_test {
namespace {

using namespace std::string_view_literals;

constexpr float kMax = std::numeric_limits<float>::max();
constexpr float kLeast = std::numeric_limits<float>::denorm_min();
constexpr float kLeastNormal = std::numeric_limits<float>::min();

std::string zeros(std::size_t count) { return std::string(count, '0'); }

/// The bits of the float that a text names; empty if it names none.
std::optional<std::uint32_t> bits_of(std::string_view text) {
  const std::optional<float> value = float_from_hex(text);
  if (!value) return std::nullopt;
  return std::bit_cast<std::uint32_t>(*value);
}

std::optional<std::uint32_t> bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// Expects that a text is refused for its value and not for its form.
void expect_no_float(const std::string& text) {
  SCOPED_TRACE(text.substr(0, 80));
  EXPECT_TRUE(is_hex_float(text));
  EXPECT_EQ(float_from_hex(text), std::nullopt);
}

TEST(FloatFromHex, ReadsValueSignAndExponent) {
  EXPECT_EQ(bits_of("0x1.8p-2"), bits(0.375F));
  EXPECT_EQ(bits_of("-0x1.8p-2"), bits(-0.375F));
  EXPECT_EQ(bits_of("+0x1.8p+2"), bits(6.0F));
  EXPECT_EQ(bits_of("0x10"), bits(16.0F));
  EXPECT_EQ(bits_of("0xa.8p0"), bits(10.5F));
  EXPECT_EQ(bits_of("0x0.08p4"), bits(0.5F));
  EXPECT_EQ(bits_of("0x1p0007"), bits(128.0F));
}

TEST(FloatFromHex, UpperCaseIsTheSame) {
  EXPECT_EQ(bits_of("-0X1.ABCDEP-3"), bits_of("-0x1.abcdep-3"));
  EXPECT_EQ(bits_of("0XFF"), bits(255.0F));
}

TEST(FloatFromHex, ZeroKeepsItsSign) {
  EXPECT_EQ(bits_of("0x0p0"), bits(0.0F));
  EXPECT_EQ(bits_of("-0x0p0"), bits(-0.0F));
  EXPECT_EQ(bits_of("-0x0"), bits(-0.0F));
  EXPECT_EQ(bits_of("-0x0.000p-7"), bits(-0.0F));
}

TEST(FloatFromHex, TwentyFourBitsFitAndTwentyFiveDoNot) {
  EXPECT_EQ(bits_of("0x1.fffffep0"), bits(std::nextafter(2.0F, 0.0F)));
  EXPECT_EQ(bits_of("0xffffffp0"), bits(16777215.0F));
  EXPECT_EQ(bits_of("0x1000000p0"), bits(16777216.0F));
  expect_no_float("0x1.ffffffp0");
  expect_no_float("0x1000001p0");
  expect_no_float("0x1.000001p0");
  expect_no_float("-0x1.000001p-100");
}

// Seven hex digits hold up to 28 bits, and the 24 bits that count may lie anywhere among these.
TEST(FloatFromHex, TheBitsThatCountNeedNotBeginADigit) {
  EXPECT_EQ(bits_of("0x1.fffffep3"), bits_of("0xf.fffffp0"));
  EXPECT_EQ(bits_of("0x7.fffff8p0"), bits_of("0x1.fffffep2"));
  expect_no_float("0x7.fffffcp0");
}

TEST(FloatFromHex, TheSmallestSubnormalIsTwoToTheMinus149) {
  EXPECT_EQ(bits_of("0x1p-149"), bits(kLeast));
  EXPECT_EQ(bits_of("-0x1p-149"), bits(-kLeast));
  EXPECT_EQ(bits_of("0x0.8p-148"), bits(kLeast));
  EXPECT_EQ(bits_of("0x1.8p-148"), bits(3 * kLeast));
  expect_no_float("0x1p-150");
  expect_no_float("0x1.8p-149");
  expect_no_float("0x1p-151");
}

TEST(FloatFromHex, SubnormalsHaveFewerBits) {
  EXPECT_EQ(bits_of("0x0.fffffep-126"), bits(std::nextafter(kLeastNormal, 0.0F)));
  EXPECT_EQ(bits_of("0x1.fffffcp-127"), bits(std::nextafter(kLeastNormal, 0.0F)));
  EXPECT_EQ(bits_of("0x1p-126"), bits(kLeastNormal));
  expect_no_float("0x1.fffffep-127");
  expect_no_float("0x0.ffffffp-126");
}

TEST(FloatFromHex, TheLargestIsFloatMax) {
  EXPECT_EQ(bits_of("0x1.fffffep+127"), bits(kMax));
  EXPECT_EQ(bits_of("-0x1.fffffep+127"), bits(-kMax));
  EXPECT_EQ(bits_of("0xffffffp104"), bits(kMax));
  expect_no_float("0x1p128");
  expect_no_float("-0x1p128");
  expect_no_float("0x1.ffffffp127");
  expect_no_float("0x1.fffffep128");
}

TEST(FloatFromHex, ZerosThatCarryNoBitsAreFreeHoweverMany) {
  EXPECT_EQ(bits_of("0x" + zeros(300) + "1p0"), bits(1.0F));
  EXPECT_EQ(bits_of("0x1." + zeros(300) + "p0"), bits(1.0F));
  EXPECT_EQ(bits_of("-0x" + zeros(300) + "." + zeros(300) + "p0"), bits(-0.0F));
  EXPECT_EQ(bits_of("0x0." + zeros(299) + "1p1200"), bits(1.0F));
  EXPECT_EQ(bits_of("0x1" + zeros(300) + "p-1200"), bits(1.0F));
  EXPECT_EQ(bits_of("0x1p" + zeros(300) + "3"), bits(8.0F));
  EXPECT_EQ(bits_of("0x1p-" + zeros(300) + "3"), bits(0.125F));
}

// Kills: reading through a double, which rounds both numbers to 1.
TEST(FloatFromHex, ABitFarBehindIsNotRoundedAway) {
  expect_no_float("0x1.000000000000000000000000000001p0");
  expect_no_float("0x1." + zeros(300) + "1p0");
  expect_no_float("0x1" + zeros(300) + "1p-1204");
}

TEST(FloatFromHex, HugeExponentsAreBeyondFloatUnlessTheDigitsAreZero) {
  for (const char* exponent :
       {"99999999999999999999", "-99999999999999999999", "9223372036854775807",
        "-9223372036854775808", "2147483648", "-4294967296", "4294967296", "1024", "-1100"}) {
    expect_no_float(std::string("0x1p") + exponent);
    expect_no_float(std::string("-0x123.456p") + exponent);
    EXPECT_EQ(bits_of(std::string("0x0p") + exponent), bits(0.0F)) << exponent;
    EXPECT_EQ(bits_of(std::string("-0x0.0p") + exponent), bits(-0.0F)) << exponent;
  }
}

TEST(FloatFromHex, WhatIsNoHexFloatFromFirstToLastCharacterIsNone) {
  for (const std::string_view text : {""sv,
                                      "-"sv,
                                      "0"sv,
                                      "1"sv,
                                      "1.5"sv,
                                      "0x"sv,
                                      "0x."sv,
                                      "0xp0"sv,
                                      "0x.8p0"sv,
                                      "0x1."sv,
                                      "0x1.p0"sv,
                                      "0x1p"sv,
                                      "0x1p+"sv,
                                      "0x1p-"sv,
                                      "0x1p+-1"sv,
                                      "0x1p-+1"sv,
                                      "0x1p++1"sv,
                                      "0x1p--1"sv,
                                      "0x1pa"sv,
                                      "0x1p1.5"sv,
                                      "0x1p0 "sv,
                                      " 0x1p0"sv,
                                      "0x1 p0"sv,
                                      "0x1p 0"sv,
                                      "- 0x1p0"sv,
                                      "--0x1p0"sv,
                                      "+-0x1p0"sv,
                                      "0x-1p0"sv,
                                      "0x1.8.0p0"sv,
                                      "0x1g"sv,
                                      "0x1,8p0"sv,
                                      "0x1p0f"sv,
                                      "0x1p0\0"sv,
                                      "x1p0"sv,
                                      "00x1p0"sv,
                                      "1p0"sv,
                                      "nan"sv,
                                      "inf"sv,
                                      "-infinity"sv,
                                      "0xnan"sv,
                                      "0x1p99999999999999999999x"sv,
                                      "0x0x1p0"sv}) {
    EXPECT_FALSE(is_hex_float(text)) << text;
    EXPECT_EQ(float_from_hex(text), std::nullopt) << text;
  }
}

TEST(ExactFloat, TakesWhatFloatHoldsAndKeepsItsSign) {
  EXPECT_EQ(exact_float(0.5), 0.5F);
  EXPECT_EQ(exact_float(16777216.0), 16777216.0F);
  EXPECT_EQ(exact_float(double{kMax}), kMax);
  EXPECT_EQ(exact_float(0x1p-149), kLeast);
  EXPECT_EQ(exact_float(0x1.fffffcp-127), std::nextafter(kLeastNormal, 0.0F));
  EXPECT_TRUE(std::signbit(exact_float(-0.0).value()));
  EXPECT_FALSE(std::signbit(exact_float(0.0).value()));
}

TEST(ExactFloat, RefusesWhatFloatWouldRound) {
  for (const double value : {0.1, 16777217.0, 0x1.000001p0, 0x1p-150, 0x1.8p-149, 0x1p128,
                             0x1.ffffffp127, 1e39, 1e300, 5e-324}) {
    EXPECT_EQ(exact_float(value), std::nullopt) << value;
    EXPECT_EQ(exact_float(-value), std::nullopt) << -value;
  }
}

TEST(ExactFloat, RefusesWhatIsNotFinite) {
  EXPECT_EQ(exact_float(std::numeric_limits<double>::infinity()), std::nullopt);
  EXPECT_EQ(exact_float(-std::numeric_limits<double>::infinity()), std::nullopt);
  EXPECT_EQ(exact_float(std::numeric_limits<double>::quiet_NaN()), std::nullopt);
}

// Files in git contain these texts, so they must not change.
TEST(ToHex, IsTheShortestNormalizedText) {
  EXPECT_EQ(to_hex(0.0F), "0x0p+0");
  EXPECT_EQ(to_hex(-0.0F), "-0x0p+0");
  EXPECT_EQ(to_hex(1.0F), "0x1p+0");
  EXPECT_EQ(to_hex(-0.375F), "-0x1.8p-2");
  EXPECT_EQ(to_hex(kMax), "0x1.fffffep+127");
  EXPECT_EQ(to_hex(kLeast), "0x1p-149");
  EXPECT_EQ(to_hex(std::nextafter(kLeastNormal, 0.0F)), "0x1.fffffcp-127");
}

/// Finite floats in which each bit is as likely to be set as not.
rc::Gen<float> any_finite_float() {
  return rc::gen::map(rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint32_t>()),
                      [](std::uint32_t pattern) {
                        // An exponent of all ones means NaN or infinity: clear one of its bits.
                        if ((pattern & 0x7f800000U) == 0x7f800000U) pattern &= ~0x00800000U;
                        return std::bit_cast<float>(pattern);
                      });
}

// Kills: a digit too few; losing the sign of zero; flushing subnormal numbers.
RC_GTEST_PROP(ToHex, ReadBackGivesTheSameBits, ()) {
  const float value = *any_finite_float();
  RC_ASSERT(bits_of(to_hex(value)) == bits(value));
  RC_ASSERT(bits(exact_float(double{value}).value()) == bits(value));
}

// Kills: a comparison with a tolerance; a mantissa limit one bit too wide.
RC_GTEST_PROP(ExactFloat, RefusesEveryDoubleBetweenNeighbouringFloats, ()) {
  const float value = *any_finite_float();
  const double above = std::nextafter(double{value}, std::numeric_limits<double>::infinity());
  const double below = std::nextafter(double{value}, -std::numeric_limits<double>::infinity());
  RC_ASSERT(!exact_float(above).has_value());
  RC_ASSERT(!exact_float(below).has_value());
}

}  // namespace
}  // namespace rastercheck::cases::float_text_test
