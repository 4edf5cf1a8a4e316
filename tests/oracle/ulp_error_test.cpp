#include "oracle/internal/ulp_error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/internal/rational_number.h"
#include "oracle/ulp.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::ulp_error_test {
namespace {

Ring ring(double value) { return {value}; }

TEST(Fractions, CompareWithoutDividing) {
  const Fraction third{ring(1), ring(3)};
  const Fraction two_sixths{ring(2), ring(6)};
  EXPECT_EQ(compare(third, two_sixths), 0);
  EXPECT_EQ(compare(third, Fraction{ring(1), ring(2)}), -1);
  EXPECT_EQ(compare(ring(0.25), third), -1);
  EXPECT_EQ(compare(ring(0.5), third), 1);
  EXPECT_EQ(compare(ring(-0.5), Fraction{ring(-3), ring(6)}), 0);
}

TEST(Fractions, HaveAHullOfThoseThatAreThere) {
  const FractionRange thirds{{ring(1), ring(3)}, {ring(2), ring(3)}};
  const FractionRange halves{{ring(-1), ring(2)}, {ring(1), ring(2)}};
  const auto both = hull(thirds, halves);
  ASSERT_TRUE(both.has_value());
  EXPECT_EQ(both->lo.value(), Field(-1, 2));
  EXPECT_EQ(both->hi.value(), Field(2, 3));
  EXPECT_EQ(hull(thirds, std::nullopt)->lo.value(), Field(1, 3));
  EXPECT_EQ(hull(std::nullopt, halves)->hi.value(), Field(1, 2));
  EXPECT_FALSE(hull(std::nullopt, std::nullopt).has_value());
}

TEST(Fractions, EncloseThemselves) {
  const records::Enclosure third = enclose(Fraction{ring(1), ring(3)});
  EXPECT_LT(third.lo, third.hi);
  EXPECT_LE(third.hi - third.lo, 4 * 0x1p-54);
  EXPECT_EQ(enclose(Fraction{ring(0), ring(3)}), (records::Enclosure{0, 0}));
}

// Kills: quotients computed in double although the operands are beyond the range of double.
TEST(Fractions, EncloseWhatDoublesCannotHold) {
  const Ring huge = ring(0x1p1000) * ring(0x1p1000);
  const records::Enclosure third = enclose(Fraction{huge, huge * ring(3)});
  EXPECT_EQ(third, enclose(Field(1, 3)));
}

// By hand: scale 4 has an ulp of 2^-21, so the error of f against 1/3 is (f − 1/3) 2^21.
TEST(UlpErrors, AreMeasuredInUlpOfTheScale) {
  const Fraction third{ring(1), ring(3)};
  const UlpError error(ring(0.5), third, scale_exponent(ring(4)));
  EXPECT_EQ(error.value(), Field(1, 6) * Field(1 << 21));
  EXPECT_TRUE(contains(error.enclosure(), (1 << 21) / 6.0));
  EXPECT_FALSE(error.is_zero());
}

// For scales below 2^-126, and for zero, the unit is 2^-149.
TEST(UlpErrors, HaveALeastUnit) {
  const UlpError of_zero(ring(0x1p-149), Fraction{}, scale_exponent(ring(0)));
  EXPECT_EQ(of_zero.value(), Field(1));
  const UlpError of_subnormal(ring(0), Fraction{ring(0x1p-130), ring(1)},
                              scale_exponent(ring(0x1p-130)));
  EXPECT_EQ(of_subnormal.value(), Field(-(1 << 19)));
}

TEST(UlpErrors, ThatAreZeroSaySo) {
  EXPECT_TRUE(UlpError().is_zero());
  const UlpError exact(ring(0.25), {ring(1), ring(4)}, scale_exponent(ring(1)));
  EXPECT_TRUE(exact.is_zero());
  EXPECT_EQ(exact.enclosure(), (records::Enclosure{0, 0}));
}

// Compares with the other implementation, oracle/ulp.h, which divides first. Kills: a wrong
// exponent if the value is at or above a power of two that the scale is below.
RC_GTEST_PROP(UlpErrors, AreThoseOfScaleUlpError, ()) {
  const float computed = random_float(4);
  const float numerator = random_float(4);
  const float divisor = random_float(4);
  const float magnitude = random_float(4);
  RC_PRE(divisor != 0);
  const Ring d = oracle::magnitude(exact_ring(divisor));
  const Ring scale = oracle::magnitude(exact_ring(magnitude));
  const UlpError error(exact_ring(computed), {exact_ring(numerator), d}, scale_exponent(scale));
  const records::Enclosure expected = scale_ulp_error(
      computed, to_rational(quotient(exact_ring(numerator), d)), to_rational(Field(scale)));
  RC_ASSERT(enclose(error.value()) == expected);
  const records::Enclosure quick = error.enclosure();
  RC_ASSERT(quick.lo <= expected.lo && expected.hi <= quick.hi);
}

}  // namespace
}  // namespace rastercheck::oracle::ulp_error_test
