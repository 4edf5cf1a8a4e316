#include "rasterizer/methods/internal/wide_float.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/rasterizer/exact.h"

namespace rastercheck::rasterizer::wide_float_test {
namespace {

// Kills: rounding towards zero; ties rounded away from even; a lost carry.
TEST(WideFloat, HasTheBitsOfFloatWithinItsRange) {
  Random random(1);
  for (int i = 0; i < 200'000; ++i) {
    const float a = random.real(-40, 40);
    const float b = random.real(-40, 40);
    const WideFloat wide_a(a);
    const WideFloat wide_b(b);
    EXPECT_EQ(static_cast<double>(wide_a + wide_b), double{a + b});
    EXPECT_EQ(static_cast<double>(wide_a - wide_b), double{a - b});
    EXPECT_EQ(static_cast<double>(wide_a * wide_b), double{a * b});
    if (b != 0) {
      EXPECT_EQ(static_cast<double>(wide_a / wide_b), double{a / b});
    }
  }
}

TEST(WideFloat, RoundsToTwentyFourBitsTiesToEven) {
  EXPECT_EQ(static_cast<double>(WideFloat(0x1.000001p0)), 1);
  EXPECT_EQ(static_cast<double>(WideFloat(0x1.000003p0)), 0x1.000004p0);
  EXPECT_EQ(static_cast<double>(WideFloat(0x1.0000010000001p0)), 0x1.000002p0);
  EXPECT_EQ(static_cast<double>(WideFloat(-0x1.ffffffp0)), -2);
  EXPECT_TRUE(std::signbit(static_cast<double>(WideFloat(-0.0))));
}

// Kills: values stored in float.
TEST(WideFloat, GoesBeyondItsRange) {
  const WideFloat tiny = WideFloat(0x1.8p-149) * WideFloat(0x1.8p-149);
  EXPECT_EQ(static_cast<double>(tiny), 0x1.2p-297);
  EXPECT_EQ(static_cast<double>(WideFloat(0x1p127) * WideFloat(0x1.8p127)), 0x1.8p254);
}

TEST(WideFloat, KeepsInfinitiesAndNan) {
  const WideFloat infinity(std::numeric_limits<double>::infinity());
  EXPECT_EQ(static_cast<double>(infinity), std::numeric_limits<double>::infinity());
  EXPECT_EQ(static_cast<double>(-infinity), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(static_cast<double>(infinity - infinity)));
  EXPECT_TRUE(std::isnan(static_cast<double>(WideFloat(0) / WideFloat(0))));
}

}  // namespace
}  // namespace rastercheck::rasterizer::wide_float_test
