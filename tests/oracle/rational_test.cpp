#include "oracle/rational.h"

#include <gtest/gtest.h>

#include <limits>

#include "oracle/internal/rational_number.h"

namespace rastercheck::oracle::rational_test {
namespace {

Rational ratio(int p, int q) { return to_rational(Field(p, q)); }

TEST(Rational, IsPrintedInLowestTerms) {
  EXPECT_EQ(ratio(10, 4).to_string(), "5/2");
  EXPECT_EQ(ratio(-6, 3).to_string(), "-2");
  EXPECT_EQ(ratio(0, 7).to_string(), "0");
  EXPECT_EQ(Rational(0.1).to_string(), "3602879701896397/36028797018963968");
  EXPECT_EQ(Rational(-0.0).to_string(), "0");
  EXPECT_EQ(Rational().to_string(), "0");
}

TEST(Rational, IsOrderedExactly) {
  EXPECT_LT(ratio(1, 3), Rational(0.3333333333333334));
  EXPECT_GT(ratio(1, 3), Rational(0.3333333333333333));
  EXPECT_EQ(ratio(2, 6), ratio(1, 3));
}

TEST(Rational, EnclosesItself) {
  EXPECT_EQ(ratio(3, 8).enclosure(), (records::Enclosure{0.375, 0.375}));
  const records::Enclosure third = ratio(1, 3).enclosure();
  EXPECT_EQ(third.lo, 0.3333333333333333);
  EXPECT_EQ(third.hi, 0.33333333333333337);
}

// 2^53 + 1 lies midway between two doubles; a slightly larger number is nearer to the upper one.
// Kills: an enclosure's lower end returned as the nearest double.
TEST(Rational, HasANearestDouble) {
  EXPECT_EQ(ratio(3, 8).nearest_double(), 0.375);
  EXPECT_EQ(ratio(1, 3).nearest_double(), 0.3333333333333333);
  EXPECT_EQ(ratio(2, 3).nearest_double(), 0.6666666666666666);
  EXPECT_EQ(ratio(3, 5).nearest_double(), 0.6);  // its upper neighbour
  const Field middle = Field(0x1p53) + Field(1);
  EXPECT_EQ(to_rational(middle).nearest_double(), 0x1p53);
  EXPECT_EQ(to_rational(middle + Field(1, 1000)).nearest_double(), 0x1p53 + 2);
  EXPECT_EQ(to_rational(Field(0x1p1023) * Field(4)).nearest_double(),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(to_rational(Field(0x1p1023) * Field(-4)).nearest_double(),
            -std::numeric_limits<double>::infinity());
}

TEST(Rational, HasANearestFloat) {
  EXPECT_EQ(ratio(1, 3).nearest_float(), 0x1.555556p-2F);
  EXPECT_EQ(Rational(1e300).nearest_float(), std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace rastercheck::oracle::rational_test
