#include "properties/generators/internal/exact_splits.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace rastercheck::properties::exact_splits_test {
namespace {

/// True if a + b is `sum` without rounding (Knuth).
bool is_exact_sum(double a, double b, double sum) {
  const double shadow = sum - a;
  return a + b == sum && (a - (sum - shadow)) + (b - shadow) == 0;
}

TEST(RayThrough, AppearsAtItsPoint) {
  cases::Case c;
  c.viewport = {-3, 0.5F, 16, 32};
  const Ray vulkan = ray_through(c, {7, 4.5});
  EXPECT_EQ(vulkan.x / vulkan.w, 2.0 * (7 + 3) / 16 - 1);
  EXPECT_EQ(vulkan.y / vulkan.w, 2.0 * (4.5 - 0.5) / 32 - 1);
  EXPECT_TRUE(1 <= vulkan.w && vulkan.w < 2);
  c.rules = cases::Rules::d3d;
  EXPECT_EQ(ray_through(c, {7, 4.5}).y, -vulkan.y);
  c.rules = cases::Rules::vulkan;
  c.viewport = {-3, 32.5F, 16, -32};
  EXPECT_EQ(ray_through(c, {7, 4.5}).y, -vulkan.y);
  EXPECT_EQ(ray_through(c, {7, 4.5}).w, vulkan.w);
}

/// Numbers of up to 40 bits, with a wide range of exponents.
double random_total(Draw& draw) {
  const int bits = draw.between(0, 40);
  const int exponent = draw.between(-50, 20);
  const bool is_negative = draw.one_in(2);
  const double magnitude = static_cast<double>(draw.bits(bits)) * power_of_two(exponent);
  return is_negative ? -magnitude : magnitude;
}

TEST(SplitInTwo, AddsUpExactly) {
  int split = 0;
  int far_apart = 0;
  int opposite = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Draw draw(1, "split in two", i);
    const double total = random_total(draw);
    const auto parts = split_in_two(draw, total);
    if (!parts) continue;
    const double a = (*parts)[0];
    const double b = (*parts)[1];
    EXPECT_TRUE(is_exact_sum(a, b, total)) << i;
    ++split;
    const double ratio = std::abs(a / b);
    far_apart += ratio < 0x1p-20 || ratio > 0x1p20 ? 1 : 0;
    opposite += a * b < 0 ? 1 : 0;
  }
  EXPECT_GT(split, 600);
  EXPECT_GT(far_apart, 100);
  EXPECT_GT(opposite, 100);
}

/// True if two of the parts have an exact sum, and adding the third is exact too.
bool is_exact_sum_of_three(const std::array<float, 3>& parts, double total) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = parts[(k + 1) % 3];
    const double b = parts[(k + 2) % 3];
    if (is_exact_sum(a, b, a + b) && is_exact_sum(a + b, parts[k], total)) return true;
  }
  return false;
}

TEST(SplitInThree, AddsUpExactly) {
  int split = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Draw draw(1, "split in three", i);
    const double total = random_total(draw);
    const auto parts = split_in_three(draw, total);
    if (!parts) continue;
    EXPECT_TRUE(is_exact_sum_of_three(*parts, total)) << i;
    ++split;
  }
  EXPECT_GT(split, 500);
}

TEST(SplitOffOpposites, AddsUpExactly) {
  int split = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Draw draw(1, "split off opposites", i);
    const double total = random_total(draw);
    const auto parts = split_off_opposites(draw, total);
    if (!parts) continue;
    EXPECT_TRUE(is_exact_sum_of_three(*parts, total)) << i;
    ++split;
  }
  EXPECT_GT(split, 500);
}

TEST(NudgeSmallest, MovesTheSmallestThatIsNotZero) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    Draw draw(1, "nudge", i);
    float a = 1;
    float b = -0x1p-10F;
    float c = 0;
    nudge_smallest(draw, std::array{&a, &b, &c});
    EXPECT_EQ(a, 1);
    EXPECT_EQ(c, 0);
    EXPECT_TRUE(b == std::nextafter(-0x1p-10F, -1.0F) || b == std::nextafter(-0x1p-10F, 1.0F));
  }
  Draw draw(1, "nudge", 0);
  float zero = 0;
  nudge_smallest(draw, std::array{&zero});
  EXPECT_EQ(zero, 0);
}

}  // namespace
}  // namespace rastercheck::properties::exact_splits_test
