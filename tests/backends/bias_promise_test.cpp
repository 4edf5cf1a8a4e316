// Tests what api_promise() says about a depth bias and unorm depth.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "backends/api_promise.h"
#include "backends/internal/plane_error.h"
#include "cases/case.h"

namespace rastercheck::backends::bias_promise_test {
namespace {

constexpr ApiLimits kLimits{8};
constexpr auto kSpec = cases::DriverPromise::spec;
/// The bound where nothing is promised.
constexpr float kNothing = 0x1p24F;

cases::Case case_of(const std::array<cases::ClipVertex, 3>& triangle) {
  cases::Case c;
  c.framebuffer = {64, 64, 1};
  c.viewport = {0, 0, 64, 64, 0, 1};
  c.positions.assign(triangle.begin(), triangle.end());
  c.triangles = {{0, 1, 2}};
  return c;
}

/// A triangle of constant depth.
cases::Case plain(float z = 0.375F) {
  return case_of({{{-0.5F, -0.5F, z, 1}, {0.5F, -0.5F, z, 1}, {0, 0.5F, z, 1}}});
}

float bound(const cases::Case& c, cases::DriverPromise promise = kSpec) {
  return api_promise(c, kLimits, promise).bounds.depth.constant;
}

TEST(BiasPromise, LeavesOpenWhatTheSpecificationsLeaveOpen) {
  cases::Case c = plain();
  c.depth_format = cases::DepthFormat::unorm16;
  cases::Contract contract = api_promise(c, kLimits, kSpec);
  EXPECT_EQ(contract.depth_format, cases::DepthFormat::unorm16);
  EXPECT_EQ(contract.depth_store, cases::DepthStore::either);
  EXPECT_EQ(contract.depth_bias,
            (cases::BiasPromise{cases::BiasSlope::between, cases::BiasUnit::open,
                                cases::BiasExponent::open}));
  contract = api_promise(c, kLimits, cases::DriverPromise::conformance);
  EXPECT_EQ(contract.depth_bias.unit, cases::BiasUnit::open);
  contract = api_promise(c, kLimits, cases::DriverPromise::ieee);
  EXPECT_EQ(contract.depth_bias.unit, cases::BiasUnit::either_power);
  EXPECT_EQ(contract.depth_store, cases::DepthStore::either);
}

TEST(BiasPromise, IsNoneWithoutABias) {
  const float without = bound(plain());
  cases::Case c = plain();
  c.depth_bias.clamp = 0.5F;
  EXPECT_EQ(bound(c), without);
  c.depth_format = cases::DepthFormat::unorm24;
  EXPECT_EQ(bound(c), without);
}

// Computed by hand for a right-angled triangle with legs of 32 pixels (ApiPromise,
// ValueErrorsAreBoundedByThePlanes), of values from 0 to 1/2.
TEST(BiasPromise, SlopeErrorsFollowFromTheGradient) {
  const WindowTriangle triangle{{0, 32, 0}, {0, 0, 32}, {1, 1, 1}};
  const SlopeError slope = slope_error(triangle, {0, 0.5, 0.25}, 1e-7, {.operation = 1e-6});
  EXPECT_NEAR(slope.most, std::hypot(1.0 / 64, 1.0 / 128), 1e-15);
  const auto along = [](double derivative) {
    return ((4e-7 + 12e-6 * 0.5) / 32 + (5 * 11e-6 + 2e-6) * derivative) / (1 - 5 * 11e-6);
  };
  const double both = std::hypot(along(1.0 / 64), along(1.0 / 128));
  EXPECT_NEAR(slope.error, both + 3e-6 * (slope.most + both), 1e-15);
  const SlopeError none = slope_error({{0, 32, 16}, {0, 0, 0.01}, {1, 1, 1}}, {0, 0, 0}, 0,
                                      {.operation = 1e-9, .reach = 0.01});
  EXPECT_TRUE(std::isinf(none.error) && std::isinf(none.most));
}

// Slopes in float32, by several formulas, of triangles of all sizes and shapes.
TEST(BiasPromise, SlopeErrorsCoverRoundedArithmetic) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0, 64);
  std::uniform_real_distribution<float> depth(0, 1);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const float size = std::ldexp(1.0F, -(i % 8));
    std::array<float, 3> x{};
    std::array<float, 3> y{};
    std::array<float, 3> z{};
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = 30 + place(random) * size;
      y[k] = 7 + place(random) * size;
      z[k] = depth(random);
    }
    const WindowTriangle triangle{{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {1, 1, 1}};
    const std::array<double, 3> values{z[0], z[1], z[2]};
    const SlopeError error = slope_error(triangle, values, 0, {.operation = 0x1p-24});
    const auto gradient = [&](auto number) {
      using Number = decltype(number);
      const auto minus = [](float a, float b) { return Number{a} - Number{b}; };
      const Number area =
          minus(x[1], x[0]) * minus(y[2], y[0]) - minus(x[2], x[0]) * minus(y[1], y[0]);
      const Number by_x =
          minus(z[1], z[0]) * minus(y[2], y[0]) - minus(z[2], z[0]) * minus(y[1], y[0]);
      const Number by_y =
          minus(x[1], x[0]) * minus(z[2], z[0]) - minus(x[2], x[0]) * minus(z[1], z[0]);
      return std::array{by_x / area, by_y / area, by_x * (1 / area), by_y * (1 / area)};
    };
    const std::array<double, 4> exact = gradient(0.0);
    const std::array<float, 4> rounded = gradient(0.0F);
    const double greatest = std::max(std::fabs(exact[0]), std::fabs(exact[1]));
    const double root = std::hypot(exact[0], exact[1]);
    ASSERT_LE(root, error.most * (1 + 0x1p-40));
    for (const std::size_t first : {0U, 2U}) {
      const float by_x = rounded[first];
      const float by_y = rounded[first + 1];
      const double of_greatest =
          std::fabs(double{std::max(std::fabs(by_x), std::fabs(by_y))} - greatest);
      const double of_root = std::fabs(double{std::sqrt(by_x * by_x + by_y * by_y)} - root);
      ASSERT_LE(std::max(of_greatest, of_root), error.error);
      worst = std::max(worst, std::max(of_greatest, of_root) / error.error);
    }
  }
  EXPECT_GT(worst, 0.02);  // the bound is no idle one
}

TEST(BiasPromise, OffsetsAddTheirErrors) {
  // Without the bias, the bound is share · 2^24 · 1.01 + 1/2, where share is that of the plane.
  const double share = (double{bound(plain())} - 0.5) / (0x1p24 * 1.01);
  cases::Case c = plain();
  c.depth_format = cases::DepthFormat::unorm16;
  c.depth_bias.constant = -0x1p13F;  // up to 2^13 · 2^-15 = 1/4
  const double expected = 1.25 * (share + 2e-5) + 2e-5 * 0.25;
  EXPECT_NEAR(bound(c), expected * 0x1p24 * 1.01 + 0.5, 0.5);
  // The slope of the plane is 0, but the errors of its depths look like one.
  c.depth_bias.constant = 0;
  c.depth_bias.slope = 1;
  EXPECT_GT(bound(c), bound(plain()));
  EXPECT_LT(bound(c), 1.5F * bound(plain()));
  // In ulps of the depth range, the error of the same offset is larger.
  c.depth_bias = {0x1p13F, 0, 0};
  c.viewport.max_depth = 0x1p-4F;
  EXPECT_GT(bound(c), 4 * bound(plain()));
  c.viewport.max_depth = 0;
  EXPECT_EQ(bound(c), kNothing);
}

// Where the greatest depth is a power of two, an error may halve the unit.
TEST(BiasPromise, AllowsForUnitsOfRoundedDepths) {
  const auto with_bias = [](float z) {
    cases::Case c = plain(z);
    c.depth_bias.constant = 0x1p20F;
    return bound(c, cases::DriverPromise::ieee);
  };
  // The unit is 2^-24, and may be 2^-25: 2^20 · 2^-25 are 2^19 ulps of 1.
  EXPECT_NEAR(with_bias(0.5F) - with_bias(0.625F), 0x1p19 * 1.01, 1);
  EXPECT_LT(with_bias(0.625F), 0x1p12F);
}

TEST(BiasPromise, PromisesNothingAboutSlopesOfPieces) {
  cases::Case c = case_of({{{-0.5F, -0.5F, 0.5F, 1}, {2, -0.5F, 0.5F, 1}, {0, 0.5F, 0.5F, 1}}});
  c.depth_bias.constant = 4;
  EXPECT_LT(bound(c), kNothing);
  c.depth_bias.slope = 0.5F;
  EXPECT_EQ(bound(c), kNothing);
  // Through the eye.
  c = case_of({{{-0.5F, -0.5F, 0.5F, 1}, {0.5F, -0.5F, 0.5F, 1}, {0, 0.5F, -2, -0.5F}}});
  c.depth_bias.constant = 4;
  const float constant_only = bound(c);
  c.depth_bias.slope = 0.5F;
  EXPECT_LT(constant_only, kNothing);
  EXPECT_EQ(bound(c), kNothing);
}

}  // namespace
}  // namespace rastercheck::backends::bias_promise_test
