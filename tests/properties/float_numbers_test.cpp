#include "properties/float_numbers.h"

#include <gtest/gtest.h>

namespace rastercheck::properties::float_numbers_test {
namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

TEST(PowerOfTwo, IsExact) {
  EXPECT_EQ(power_of_two(0), 1);
  EXPECT_EQ(power_of_two(63), 0x1p63);
  EXPECT_EQ(power_of_two(-63), 0x1p-63);
}

TEST(Stepped, GoesFromFloatToFloat) {
  EXPECT_EQ(stepped(1, 1), 0x1.000002p+0F);
  EXPECT_EQ(stepped(1, -1), 0x1.fffffep-1F);
  EXPECT_EQ(stepped(-1, 1), -0x1.fffffep-1F);
  EXPECT_EQ(stepped(0, 1), 0x1p-149F);
  EXPECT_EQ(stepped(-0.0F, -2), -0x1p-148F);
  EXPECT_EQ(stepped(0x1p-149F, -2), -0x1p-149F);
  EXPECT_EQ(stepped(kLargest, 1), kLargest);
  EXPECT_EQ(stepped(-kLargest, -1), -kLargest);
}

TEST(UlpOf, IsThatOfFloat32) {
  EXPECT_EQ(ulp_of(0), 0x1p-149);
  EXPECT_EQ(ulp_of(-1.5), 0x1p-23);
  EXPECT_EQ(ulp_of(0x1p-130), 0x1p-149);
}

TEST(ToFloat, IsHeldAtTheLargest) {
  EXPECT_EQ(to_float(1e300), kLargest);
  EXPECT_EQ(to_float(-1e300), -kLargest);
  EXPECT_EQ(to_float(0.5), 0.5F);
}

}  // namespace
}  // namespace rastercheck::properties::float_numbers_test
