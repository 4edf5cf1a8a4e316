#include "reports/internal/log2.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rastercheck::reports::log2_test {
namespace {

TEST(DrawnLog2, IsExactAtPowersOfTwoAndLinearBetween) {
  for (const int exponent : {-1074, -20, -1, 0, 1, 40, 1023}) {
    EXPECT_EQ(drawn_log2(std::ldexp(1, exponent)), exponent);
  }
  EXPECT_EQ(drawn_log2(1.5), 0.5);
  EXPECT_EQ(drawn_log2(7), 2.75);
  EXPECT_EQ(drawn_log2(0.75), -0.5);
}

TEST(DrawnLog2, IsAtMost009Below) {
  for (double value = 1; value < 2; value += 0x1p-8) {
    EXPECT_LE(drawn_log2(value), std::log2(value) + 1e-12);
    EXPECT_GE(drawn_log2(value), std::log2(value) - 0.09);
  }
}

// Kills: a missing term; an exponent off by one.
TEST(CurveLog2, IsTheLogarithm) {
  for (const double value : {0x1p-149, 0.001, 0.1, 0.75, 1.0, 1.4142135, 1.999999, 3.0, 1e9}) {
    EXPECT_NEAR(curve_log2(value), std::log2(value), 0x1p-40) << value;
  }
  EXPECT_EQ(curve_log2(0.125), -3);
}

}  // namespace
}  // namespace rastercheck::reports::log2_test
