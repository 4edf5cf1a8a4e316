#include "properties/exact_sum.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace rastercheck::properties::exact_sum_test {
namespace {

TEST(ExactSum, IsThereWhereADoubleHoldsIt) {
  EXPECT_EQ(exact_sum(1, 0x1p-52), 1 + 0x1p-52);
  EXPECT_FALSE(exact_sum(1, 0x1p-53));
  EXPECT_FALSE(exact_sum(0x1p-53, 1));
  EXPECT_EQ(exact_sum(-1, 1), 0);
}

TEST(ExactSum, KnowsFloats) {
  EXPECT_TRUE(is_float(0x1.fffffep127));
  EXPECT_FALSE(is_float(0x1p128));
  EXPECT_TRUE(is_float(0x1p-149));
  EXPECT_FALSE(is_float(0x1p-150));
  EXPECT_FALSE(is_float(1 + 0x1p-24));
}

TEST(ExactSum, HasTheSignOfSumsThatRoundToOthers) {
  const auto sign = [](const std::vector<double>& terms) { return sign_of_sum(terms); };
  EXPECT_EQ(sign({}), 0);
  EXPECT_EQ(sign({1, -1}), 0);
  EXPECT_EQ(sign({1, 0x1p-200, -1}), 1);
  EXPECT_EQ(sign({0x1p-200, 1, -1, -0x1p-199}), -1);
  EXPECT_EQ(sign({0x1p100, 1, -0x1p100, -0x1p-60, -1, 0x1p-60}), 0);
  EXPECT_EQ(sign({3, -1, -1, -1, 0x1p-1000}), 1);
}

}  // namespace
}  // namespace rastercheck::properties::exact_sum_test
