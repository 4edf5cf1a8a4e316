// The neighbours of doubles, against std::nextafter().

#include "oracle/internal/next_double.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rastercheck::oracle::next_double_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expect_same_bits(double actual, double expected) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(actual), std::bit_cast<std::uint64_t>(expected));
}

TEST(NextDouble, IsThatOfNextafterAtTheEndsOfEveryRange) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  constexpr double kNormal = std::numeric_limits<double>::min();
  constexpr double kGreatest = std::numeric_limits<double>::max();
  for (const double size : {0.0, kLeast, kNormal, kNormal - kLeast, 1.0, kGreatest, kInfinity}) {
    for (const double x : {size, -size}) {
      expect_same_bits(next_above(x), std::nextafter(x, kInfinity));
      expect_same_bits(next_below(x), std::nextafter(x, -kInfinity));
    }
  }
  EXPECT_TRUE(std::isnan(next_above(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(next_below(std::numeric_limits<double>::quiet_NaN())));
}

RC_GTEST_PROP(NextDouble, IsThatOfNextafter, (std::uint64_t bits)) {
  const auto x = std::bit_cast<double>(bits);
  RC_PRE(!std::isnan(x));
  RC_ASSERT(next_above(x) == std::nextafter(x, kInfinity));
  RC_ASSERT(next_below(x) == std::nextafter(x, -kInfinity));
}

}  // namespace
}  // namespace rastercheck::oracle::next_double_test
