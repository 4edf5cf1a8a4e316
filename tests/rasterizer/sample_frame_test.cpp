#include "rasterizer/internal/sample_frame.h"

#include <gtest/gtest.h>

#include "tests/rasterizer/exact_frame.h"

namespace rastercheck::rasterizer::sample_frame_test {
namespace {

SampleFrame frame_of(const State& state, const TargetSize& size) {
  return sample_frame(state, draw_bounds(state, size), size.samples);
}

/// The frame of the largest target, with the same viewport on both axes.
SampleFrame square_frame(float origin, float extent, int samples = 1) {
  State state;
  state.viewport.origin = {origin, origin};
  state.viewport.size = {extent, extent};
  return frame_of(state, {kMaxSize, kMaxSize, samples});
}

void expect_axis(const AxisFrame& axis, double position, const Rational& exact) {
  const double computed = axis.at(position);
  const Rational error = abs(Rational(computed) - exact);
  if (axis.is_exact) {
    EXPECT_EQ(error, 0);
    EXPECT_EQ(axis.error, 0);
    EXPECT_EQ(Rational(exact * power_of_two(-axis.grain)).get_den(), 1);
  }
  EXPECT_LE(error, Rational(axis.error));
  EXPECT_LE(abs(exact), Rational(axis.greatest));
  EXPECT_LE(std::abs(computed), axis.greatest);
  const ExactCoordinate parts = exact_at(axis, position);
  Rational sum = 0;
  for (std::size_t i = 0; i < parts.size; ++i) {
    sum += Rational(parts.scale) * Rational(parts.parts[i]);
  }
  EXPECT_EQ(sum, exact);
}

// Kills: an error bound that is too small; a grain that is too coarse; an ignored sign of a
// negative size.
TEST(SampleFrame, IsAsExactAsItSays) {
  Random random(30);
  for (int i = 0; i < 4'000 && !HasFailure(); ++i) {
    const FramedDraw draw = random_framed_draw(random);
    EXPECT_EQ(Rational(draw.frame.t), exact_position(draw.state, 0, 0)[2]);
    for (int k = 0; k < 4; ++k) {
      const SampleOffset at = random_sample(random, draw.bounds, draw.samples);
      const auto exact = exact_position(draw.state, at.x, at.y);
      expect_axis(draw.frame.u, at.x, exact[0]);
      expect_axis(draw.frame.v, at.y, exact[1]);
    }
  }
}

// Viewports that combine numbers from the ends of float's range.
TEST(SampleFrame, HoldsAtTheEndsOfTheFloats) {
  constexpr float kLeast = 0x1p-149F;
  constexpr float kMost = 0x1.fffffep127F;
  for (const float origin : {0.0F, kLeast, -kLeast, kMost, -kMost, 0.1F, 16'383.5F}) {
    for (const float width : {kLeast, -kLeast, kMost, -kMost, 1e-30F, 0x1p-126F, 3.0F}) {
      for (const float height : {kLeast, kMost, -7.0F}) {
        State state;
        state.viewport = {{origin, -origin}, {width, height}, 0, 1};
        const SampleFrame frame = frame_of(state, {kMaxSize, kMaxSize, 16});
        EXPECT_EQ(Rational(frame.t), abs(Rational(width) * Rational(height)));
        for (const double position : {0.0, 0.5, 0.0625, 8'191.9375, 16'383.9375}) {
          const auto exact = exact_position(state, position, position);
          expect_axis(frame.u, position, exact[0]);
          expect_axis(frame.v, position, exact[1]);
        }
      }
    }
  }
}

// Exact frames make drawing on a grid fast. A frame that is never exact would be correct but slow.
TEST(SampleFrame, IsExactOnGridsOf256) {
  EXPECT_TRUE(square_frame(0, kMaxSize).u.is_exact);
  EXPECT_TRUE(square_frame(0, kMaxSize, 16).v.is_exact);
  EXPECT_TRUE(square_frame(-0x1p15F, 0x1p15F, 8).u.is_exact);
  EXPECT_TRUE(square_frame(0x1p-8F, -640.00390625F, 4).u.is_exact);
  EXPECT_FALSE(square_frame(0x1p-9F, 640).u.is_exact);
  EXPECT_FALSE(square_frame(0, 640 + 0x1p-9F).u.is_exact);
  EXPECT_FALSE(square_frame(0, 0x1.000002p15F).u.is_exact);
  EXPECT_FALSE(square_frame(-32'769, 640).v.is_exact);
}

// U is scaled by the height, so a height with many bits, such as 4.1F, makes U inexact although all
// numbers along u have few bits.
TEST(SampleFrame, IsNotExactWhereTheOtherSizeIsOdd) {
  State state = small_state(4, 4);
  state.viewport.size.y = 4.1F;
  const SampleFrame frame = frame_of(state, {4, 4, 1});
  EXPECT_FALSE(frame.u.is_exact);
  EXPECT_FALSE(frame.v.is_exact);
}

TEST(SampleFrame, GrainTellsCentresFromSamples) {
  // In a viewport of 8 pixels, 2 x − 8 is an odd integer at the centres of pixels, and a multiple
  // of 1/8 at other samples. U is that times 8.
  EXPECT_EQ(square_frame(0, 8).u.grain, 3);
  EXPECT_EQ(square_frame(0, 8, 4).u.grain, 0);
  EXPECT_EQ(square_frame(0, 0.25F).u.grain, -4);
}

TEST(SampleFrame, DirectionsFollowTheViewportAndTheConvention) {
  for (const Convention convention : {Convention::opengl, Convention::vulkan, Convention::d3d}) {
    for (const float width : {4.0F, -4.0F}) {
      for (const float height : {4.0F, -4.0F}) {
        State state = small_state(4, 4, convention);
        state.viewport.size = {width, height};
        const SampleFrame frame = frame_of(state, {4, 4, 1});
        EXPECT_EQ(frame.u.direction, width > 0 ? 1 : -1);
        EXPECT_EQ(frame.v.direction, (height > 0) == (convention != Convention::d3d) ? 1 : -1);
        EXPECT_EQ(frame.u.at(3) > frame.u.at(2), frame.u.direction > 0);
        EXPECT_EQ(frame.v.at(3) > frame.v.at(2), frame.v.direction > 0);
        EXPECT_EQ(frame.t, 16);
      }
    }
  }
}

TEST(LowestBit, IsTheExponentOfTheLastOne) {
  EXPECT_EQ(lowest_bit(1), 0);
  EXPECT_EQ(lowest_bit(-12), 2);
  EXPECT_EQ(lowest_bit(0.75), -2);
  EXPECT_EQ(lowest_bit(0x1.0000000000001p0), -52);
  EXPECT_EQ(lowest_bit(0x1p-596), -596);
  EXPECT_EQ(lowest_bit(double{0x1.000004p-127F}), -149);
  EXPECT_GT(lowest_bit(0), 10'000);
  EXPECT_GT(lowest_bit(-0.0) + lowest_bit(0), 10'000);
}

}  // namespace
}  // namespace rastercheck::rasterizer::sample_frame_test
