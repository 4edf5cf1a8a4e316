#include "properties/random_floats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace rastercheck::properties::random_floats_test {
namespace {

TEST(AnyFloat, IsOfAllKindsAndNeverBeyond) {
  Draw draw(1, "floats", 0);
  std::map<int, int> kinds;
  for (int i = 0; i < 4000; ++i) {
    const float value = any_float(draw);
    ASSERT_TRUE(std::isfinite(value));
    ++kinds[std::fpclassify(value)];
    if (std::abs(value) == std::numeric_limits<float>::max()) ++kinds[-1];
  }
  EXPECT_GT(kinds[FP_ZERO], 300);
  EXPECT_GT(kinds[FP_SUBNORMAL], 300);
  EXPECT_GT(kinds[FP_NORMAL], 2000);
  EXPECT_GT(kinds[-1], 50);
}

TEST(FloatByBits, HasAllExponents) {
  Draw draw(1, "floats", 1);
  std::set<int> exponents;
  for (int i = 0; i < 4000; ++i) {
    const float value = float_by_bits(draw);
    ASSERT_TRUE(std::isfinite(value));
    exponents.insert(value == 0 ? -1000 : std::ilogb(value));
  }
  EXPECT_GT(exponents.size(), 250U);
}

TEST(RandomFloats, AreWhatTheirNamesSay) {
  Draw draw(1, "floats", 2);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(any_zero(draw), 0.0F);
    EXPECT_EQ(std::fpclassify(subnormal_float(draw)), FP_SUBNORMAL);
    EXPECT_GE(std::abs(huge_float(draw)), 0x1p120F);
    const float dyadic = dyadic_float(draw, 8, 5);
    EXPECT_LE(std::abs(dyadic), 8);
    EXPECT_EQ(dyadic * 32, std::floor(dyadic * 32));
    const float near = float_near(draw, 1, 3);
    EXPECT_LE(std::abs(near - 1), 8 * 0x1p-23F);
  }
  int same = 0;
  for (int i = 0; i < 1000; ++i) same += float_near(draw, 1, 3) == 1 ? 1 : 0;
  EXPECT_GT(same, 100);
}

}  // namespace
}  // namespace rastercheck::properties::random_floats_test
