#include "backends/unorm_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace rastercheck::backends::unorm_depth_test {
namespace {

constexpr std::uint32_t kGreatest = 0xFFFFFF;

TEST(UnormDepth, IsTheNearestFloat) {
  EXPECT_EQ(unorm_depth(0, 16), 0);
  EXPECT_EQ(unorm_depth(65535, 16), 1);
  EXPECT_EQ(unorm_depth(kGreatest, 24), 1);
  // 2^23/(2^24 − 1) = 1/2 + 2^-25 + 2^-49 + …, which is beyond the middle between two floats.
  EXPECT_EQ(unorm_depth(1U << 23U, 24), 0.5F + 0x1p-24F);
  EXPECT_EQ(unorm_depth(13107, 16), 0.2F);  // 65535 / 5
}

TEST(UnormDepth, TellsNumbersApart) {
  constexpr std::uint32_t kStride = 61;
  for (std::uint32_t k = kGreatest; k >= kStride; k -= kStride) {
    ASSERT_LT(unorm_depth(k - 1, 24), unorm_depth(k, 24)) << k;
    // Only the greatest numbers are fetched alike.
    ASSERT_EQ(fetched_depth(k - 1, 24, UnormFetch::multiplied) ==
                  fetched_depth(k, 24, UnormFetch::multiplied),
              k == kGreatest)
        << k;
  }
}

/// Returns what a driver fetches for telling_depths() if it stores with `store` and converts as
/// `how` says.
template <typename Store>
std::vector<float> fetched_of(int bits, UnormFetch how, const Store& store) {
  std::vector<float> fetched;
  const float steps = std::ldexp(1.0F, bits) - 1;
  for (const std::uint32_t k : telling_depths(bits)) {
    const auto stored = static_cast<std::uint32_t>(store(unorm_depth(k, bits), steps));
    fetched.push_back(fetched_depth(stored, bits, how));
  }
  return fetched;
}

TEST(UnormDepth, FindsOutHowDriversFetch) {
  for (const int bits : {16, 24}) {
    EXPECT_EQ(telling_depths(bits).size(), kTellingDepths);
    for (const UnormFetch how : {UnormFetch::divided, UnormFetch::multiplied}) {
      std::vector<float> fetched = fetched_of(
          bits, how, [](double depth, double steps) { return std::floor(depth * steps + 0.5); });
      EXPECT_EQ(fetch_of(fetched, bits), how);
      const auto truncated = [](float depth, float steps) { return depth * steps; };
      EXPECT_EQ(fetch_of(fetched_of(bits, how, truncated), bits), how);
      fetched[5] = std::nextafter(fetched[5], 2.0F);
      EXPECT_EQ(fetch_of(fetched, bits), std::nullopt);
      fetched.pop_back();
      EXPECT_EQ(fetch_of(fetched, bits), std::nullopt);
    }
  }
}

TEST(UnormDepth, IsRecoveredFromWhatWasFetched) {
  for (const UnormFetch how : {UnormFetch::divided, UnormFetch::multiplied}) {
    for (const int bits : {16, 24}) {
      const DepthReading reading{bits, how};
      const std::uint32_t greatest = (1U << static_cast<unsigned>(bits)) - 1;
      for (std::uint32_t k = 0; k < greatest - 1; k += 97) {
        const float read = fetched_depth(k, bits, how);
        EXPECT_FALSE(reading.is_open(read));
        EXPECT_EQ(reading.stored(read, true).value(), unorm_depth(k, bits)) << k;
      }
      const bool is_open = bits == 24 && how == UnormFetch::multiplied;
      EXPECT_EQ(reading.is_open(1), is_open);
      EXPECT_EQ(reading.stored(1, true).value(), 1);
      EXPECT_EQ(reading.stored(1, false).value(),
                unorm_depth(is_open ? greatest - 1 : greatest, bits));
      EXPECT_FALSE(reading.stored(1.5F, false));
      EXPECT_FALSE(reading.stored(std::numeric_limits<float>::quiet_NaN(), false));
    }
  }
  // No depth of 16 bits is 1/2.
  EXPECT_FALSE((DepthReading{16, UnormFetch::divided}.stored(0.5F, false)));
  // Depths that are read without a fetch stay as they were stored.
  EXPECT_EQ((DepthReading{24, {}}.stored(0.3F, false)).value(), 0.3F);
  EXPECT_EQ((DepthReading{}.stored(1.5F, false)).value(), 1.5F);
}

}  // namespace
}  // namespace rastercheck::backends::unorm_depth_test
