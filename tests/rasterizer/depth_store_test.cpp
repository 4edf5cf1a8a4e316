// Depths as unorm formats store them.

#include "rasterizer/internal/depth_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rastercheck::rasterizer::depth_store_test {
namespace {

constexpr double kSteps16 = 65535;
constexpr double kSteps24 = 16777215;

// Kills: a k that is not the nearest; a float for which a neighbour is nearer; two k with one
// float.
TEST(DepthStore, StoresEachStepAsAFloatOfItsOwn) {
  for (const double steps : {kSteps16, kSteps24}) {
    float last = -1;
    for (int k = 0; k <= static_cast<int>(steps); ++k) {
      // k/s to 64 bits: float and double would round what is asked about.
      const long double exact = static_cast<long double>(k) / steps;
      const float drawn = stored(static_cast<double>(exact), steps);
      ASSERT_EQ(drawn, static_cast<float>(exact)) << k;
      ASSERT_GT(drawn, last) << k;
      ASSERT_EQ(std::round(drawn * steps), k);
      last = drawn;
    }
    EXPECT_EQ(last, 1);
  }
}

TEST(DepthStore, StoresTheNearestStep) {
  EXPECT_EQ(stored(0.49999 / kSteps16, kSteps16), 0);
  EXPECT_EQ(stored(0.50001 / kSteps16, kSteps16), static_cast<float>(1 / kSteps16));
  EXPECT_EQ(stored(-0.0, kSteps16), 0);
  EXPECT_FALSE(std::signbit(stored(-0.0, kSteps16)));
  EXPECT_EQ(stored(0.1, 0), 0.1F);
}

TEST(StoredDepth, IsWhatABufferOfTheFormatHolds) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(stored_depth(DepthFormat::float32, 0.3F), 0.3F);
  EXPECT_EQ(stored_depth(DepthFormat::float32, kInfinity), kInfinity);
  // 0.25 · 65535 = 16383.75, 0.25 · 16777215 = 4194303.75
  EXPECT_EQ(stored_depth(DepthFormat::unorm16, 0.25F), static_cast<float>(16384 / kSteps16));
  EXPECT_EQ(stored_depth(DepthFormat::unorm24, 0.25F), static_cast<float>(4194304 / kSteps24));
  EXPECT_EQ(stored_depth(DepthFormat::unorm24, kInfinity), 1);
  EXPECT_EQ(stored_depth(DepthFormat::unorm16, -1), 0);
}

}  // namespace
}  // namespace rastercheck::rasterizer::depth_store_test
