#include "properties/draw.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace rastercheck::properties::draw_test {
namespace {

// From the test suite that the authors of FNV publish (draft-eastlake-fnv, appendix C).
TEST(Fnv1a, GivesThePublishedHashes) {
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325U);
  EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8U);
}

// If these words change, every case number of earlier runs stands for another case. The choices can
// be derived by hand from the words above: the first is 0xaf3… >> 57 = 87 of 0…99, and so on.
TEST(Draw, KeepsItsStream) {
  Draw draw(1, "a law", 7);
  std::vector<std::uint64_t> words(7);
  for (std::uint64_t& word : words) word = draw.bits(64);
  EXPECT_EQ(words,
            (std::vector<std::uint64_t>{0xaf3b2ff5dc9d258d, 0x1e0aee6b47613ed1, 0xad8c41f66873804f,
                                        0x07a111669b97f1bc, 0x19744310fb13c520, 0x64ee0796c6c211a9,
                                        0x0cfa281ff988e2bb}));

  Draw choices(1, "a law", 7);
  const int between = choices.between(-3, 96);
  const float unit = choices.unit();
  const float uniform = choices.uniform(-2, 5);
  const float spread = choices.spread(-149, 127);
  EXPECT_EQ(between, 84);
  EXPECT_EQ(unit, 0x1.e0aeep-4F);
  EXPECT_EQ(uniform, 0x1.5f6ae4p+1F);
  EXPECT_EQ(spread, -0x1.6p-134F);  // exponent 15 − 149; then three bits of mantissa, 011

  Draw far(0xffffffffffffffff, "values stay within the bound", std::uint64_t{1} << 40);
  EXPECT_EQ(far.bits(64), 0x924ab8b56b105034U);
}

TEST(Draw, DependsOnSeedPropertyAndIndexAlone) {
  const auto first = [](std::uint64_t seed, const char* property, std::uint64_t index) {
    Draw draw(seed, property, index);
    return draw.bits(64);
  };
  EXPECT_EQ(first(1, "a law", 5), first(1, "a law", 5));
  const std::set<std::uint64_t> different{first(1, "a law", 5), first(2, "a law", 5),
                                          first(1, "b law", 5), first(1, "a law", 6)};
  EXPECT_EQ(different.size(), 4U);
}

TEST(Draw, SizeIsTheIndexModulo101) {
  EXPECT_EQ(Draw(1, "a law", 0).size(), 0);
  EXPECT_EQ(Draw(1, "a law", 100).size(), 100);
  EXPECT_EQ(Draw(1, "a law", 101).size(), 0);
  EXPECT_EQ(Draw(1, "a law", 0xffffffffffffffff).size(), 78);  // 2^64 = 79 modulo 101
}

TEST(Draw, BitsAreAsManyAsAskedFor) {
  Draw draw(1, "a law", 0);
  EXPECT_EQ(draw.bits(0), 0U);
  for (int count = 1; count <= 63; ++count) {
    std::uint64_t seen = 0;
    for (int i = 0; i < 200; ++i) seen |= draw.bits(count);
    EXPECT_EQ(seen, (std::uint64_t{1} << count) - 1) << count;
  }
}

// 7 choices do not divide a power of two: each choice must come up in 1/7 of 70,000 draws, within
// five standard deviations (of 93 each).
TEST(Draw, BetweenIsEquallyLikelyEverywhere) {
  Draw draw(1, "a law", 0);
  std::map<int, int> counts;
  for (int i = 0; i < 70000; ++i) ++counts[draw.between(-3, 3)];
  EXPECT_EQ(counts.size(), 7U);
  for (const auto& [n, count] : counts) EXPECT_NEAR(count, 10000, 465) << n;
  EXPECT_EQ(draw.between(5, 5), 5);
}

TEST(Draw, BetweenReachesBothEndsOfInt) {
  Draw draw(1, "a law", 0);
  bool is_low = false;
  bool is_high = false;
  for (int i = 0; i < 100; ++i) {
    const int n = draw.between(INT32_MIN, INT32_MAX);
    is_low = is_low || n < -(1 << 30);
    is_high = is_high || n > (1 << 30);
  }
  EXPECT_TRUE(is_low && is_high);
}

TEST(Draw, UniformNeverLeavesItsRange) {
  Draw draw(1, "a law", 0);
  const float next = std::bit_cast<float>(std::bit_cast<std::uint32_t>(1.0F) + 1);
  std::set<float> seen;
  for (int i = 0; i < 200; ++i) {
    seen.insert(draw.uniform(1, next));
    const float wide = draw.uniform(-0x1p126F, 0x1p126F);
    EXPECT_LE(std::abs(wide), 0x1p126F);
  }
  EXPECT_EQ(seen, (std::set<float>{1, next}));
}

TEST(Draw, UnitIsAMultipleOf2ToMinus24Below1) {
  Draw draw(1, "a law", 0);
  for (int i = 0; i < 200; ++i) {
    const float scaled = draw.unit() * 0x1p24F;
    EXPECT_EQ(scaled, std::floor(scaled));
    EXPECT_GE(scaled, 0);
    EXPECT_LT(scaled, 0x1p24F);
  }
}

TEST(Draw, SpreadReachesEveryExponentAndBothSigns) {
  Draw draw(1, "a law", 0);
  std::set<int> exponents;
  bool is_negative = false;
  bool is_positive = false;
  bool is_short = false;
  for (int i = 0; i < 4000; ++i) {
    const float value = draw.spread(-3, 4);
    const float magnitude = std::abs(value);
    EXPECT_GE(magnitude, 0x1p-3F);
    EXPECT_LT(magnitude, 0x1p5F);
    exponents.insert(std::ilogb(value));
    is_negative = is_negative || value < 0;
    is_positive = is_positive || value > 0;
    is_short = is_short || magnitude == 1.5F;
  }
  EXPECT_EQ(exponents, (std::set<int>{-3, -2, -1, 0, 1, 2, 3, 4}));
  EXPECT_TRUE(is_negative && is_positive && is_short);
}

TEST(Draw, SpreadGoesFromTheSmallestToTheLargestFloats) {
  Draw draw(1, "a law", 0);
  for (int i = 0; i < 500; ++i) {
    const float smallest = std::abs(draw.spread(-149, -149));
    EXPECT_TRUE(smallest == 0x1p-149F || smallest == 0x1p-148F);
    EXPECT_TRUE(std::isfinite(draw.spread(127, 127)));
  }
}

TEST(Draw, PickTakesEveryChoice) {
  Draw draw(1, "a law", 0);
  std::set<char> seen;
  for (int i = 0; i < 100; ++i) seen.insert(draw.pick(std::array{'a', 'b', 'c'}));
  EXPECT_EQ(seen, (std::set<char>{'a', 'b', 'c'}));
}

}  // namespace
}  // namespace rastercheck::properties::draw_test
