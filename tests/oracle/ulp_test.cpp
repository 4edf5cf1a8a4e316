#include "oracle/ulp.h"

#include <gtest/gtest.h>

#include "oracle/internal/rational_number.h"

namespace rastercheck::oracle::ulp_test {
namespace {

using records::Enclosure;

Rational power(long exponent) { return to_rational(power_of_two(exponent)); }
Rational ratio(int p, int q) { return to_rational(Field(p, q)); }

TEST(Ulp, FollowsTheExponentDownToTheSubnormals) {
  EXPECT_EQ(ulp(Rational(1)), power(-23));
  EXPECT_EQ(ulp(Rational(-1.999)), power(-23));
  EXPECT_EQ(ulp(Rational(2)), power(-22));
  EXPECT_EQ(ulp(ratio(1, 3)), power(-25));
  EXPECT_EQ(ulp(power(-126)), power(-149));
  EXPECT_EQ(ulp(power(-140)), power(-149));
  EXPECT_EQ(ulp(Rational(0)), power(-149));
}

TEST(LocalUlpError, IsSignedAndFractional) {
  EXPECT_EQ(local_ulp_error(0x1.000002p0F, Rational(1)), (Enclosure{1, 1}));
  EXPECT_EQ(local_ulp_error(1, Rational(0x1.000001p0)), (Enclosure{-0.5, -0.5}));
  // 0x1.555556p-2 = 11184811/2^25 exceeds 1/3 by 1/(3·2^25): a third of ulp(1/3) = 2^-25.
  const Enclosure third = local_ulp_error(0x1.555556p-2F, ratio(1, 3));
  EXPECT_EQ(third, ratio(1, 3).enclosure());
}

TEST(LocalUlpError, AgainstZeroCountsSmallestSubnormals) {
  EXPECT_EQ(local_ulp_error(-0x1p-148F, Rational(0)), (Enclosure{-2, -2}));
}

TEST(ScaleUlpError, MeasuresByTheLargestVertexValue) {
  // ulp(4) = 2^-21: a step of 2^-23 is a quarter of it.
  EXPECT_EQ(scale_ulp_error(0x1.000002p0F, Rational(1), Rational(4)), (Enclosure{0.25, 0.25}));
  // Cancelled to zero: the error is one step of the scale's ulp, not 2^126 of zero's own.
  EXPECT_EQ(scale_ulp_error(0x1p-23F, Rational(0), Rational(1)), (Enclosure{1, 1}));
}

TEST(ScaleUlpError, TakesTheExactValueWhereThatIsLarger) {
  EXPECT_EQ(scale_ulp_error(8, Rational(9), Rational(1)), (Enclosure{-0x1p20, -0x1p20}));
}

}  // namespace
}  // namespace rastercheck::oracle::ulp_test
