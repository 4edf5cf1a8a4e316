// Shaders that are ready to use (rasterizer/shading.h, texture.h).

#include <gtest/gtest.h>

#include <limits>

#include "rasterizer/texture.h"
#include "tests/rasterizer/fragment_batch.h"
#include "tests/simd_targets.h"

namespace rastercheck::rasterizer::shaders_test {
namespace {

class Shaders : public testing::TestWithParam<std::int64_t> {};
INSTANTIATE_TEST_SUITE_P(AllTargets, Shaders, testing::ValuesIn(all_targets()), target_name);

// Kills: attributes in another order; lanes left out; rounding towards zero; numbers beyond float32
// that are clamped to its greatest.
TEST_P(Shaders, AttributesAreRoundedOnce) {
  const OnTarget on_target(GetParam());
  KnownBatch known(3);
  Random random(1);
  for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
    for (std::size_t i = 0; i < 3; ++i) known.set(i, lane, random.number(53, -40, 40));
  }
  const double infinity = std::numeric_limits<double>::infinity();
  known.set(0, 5, 1e39);
  known.set(1, 6, -infinity);
  known.set(2, 7, std::numeric_limits<double>::quiet_NaN());
  known.set(0, 8, -0.0);
  ShadedLanes out(3);
  ShadedBatch batch = out.batch();
  const AttributesShader shader{3};
  EXPECT_EQ(shader.outputs(), 3U);
  shader(known.batch(), batch);
  for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == 2 && lane == 7) {
        EXPECT_NE(out(i, lane), out(i, lane));
      } else if (i == 0 && lane == 5) {
        EXPECT_EQ(out(i, lane), std::numeric_limits<float>::infinity());
      } else {
        EXPECT_EQ(out(i, lane), static_cast<float>(known.lines[i].value[lane]));
      }
    }
  }
  EXPECT_TRUE(std::signbit(out(0, 8)));
}

// Kills: an alpha that is not set; a fourth attribute that is ignored; a fifth that is used.
TEST_P(Shaders, GouraudIsOpaqueWithThreeAttributes) {
  const OnTarget on_target(GetParam());
  for (const std::size_t count : {3U, 4U, 5U}) {
    KnownBatch known(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
        known.set(i, lane, 0.125 * static_cast<double>(i + 1) + static_cast<double>(lane));
      }
    }
    ShadedLanes out;
    ShadedBatch batch = out.batch();
    GouraudShader()(known.batch(), batch);
    for (const std::size_t lane : {0U, 63U, 127U}) {
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(out(i, lane), 0.125F * static_cast<float>(i + 1) + static_cast<float>(lane));
      }
      EXPECT_EQ(out(3, lane), count == 3 ? 1.0F : 0.5F + static_cast<float>(lane));
    }
  }
}

// Kills: a value at the limit that is discarded; lanes of another cell; lanes that were discarded
// before but are drawn.
TEST_P(Shaders, WhatIsTransparentIsDiscarded) {
  const OnTarget on_target(GetParam());
  const std::array<std::uint8_t, 16> bytes{10, 20, 30, 0,   40, 50, 60, 127,
                                           70, 80, 90, 128, 1,  2,  3,  255};
  Texture texture;
  ASSERT_FALSE(Texture::make(4, 1, bytes, texture));
  KnownBatch known(3);
  for (std::size_t lane = 0; lane < KnownBatch::kLanes; ++lane) {
    known.set(1, lane, (static_cast<double>((lane + lane / 16) % 4) + 0.5) / 4);
  }
  known.cells.resize(5);
  const Sampler sampler{Wrap::repeat, Wrap::repeat, Filter::nearest};
  TexturedShader shader{&texture, sampler, 1, 2, {}};
  EXPECT_EQ(shader.outputs(), 4U);
  EXPECT_FALSE(shader.uses_derivatives());
  ShadedLanes out;
  ShadedBatch batch = out.batch();
  shader(known.batch(), batch);
  for (const std::uint16_t bits : out.discarded) EXPECT_EQ(bits, 0);
  EXPECT_EQ(out(0, 1), 40 / 255.0F);
  EXPECT_EQ(out(3, 16), 127 / 255.0F);
  EXPECT_EQ(out(0, 80), -1.0F);  // beyond the batch
  shader.discard_below = 128 / 255.0F;
  batch.discard(2);
  shader(known.batch(), batch);
  for (std::size_t cell = 0; cell < FragmentBatch::kCells; ++cell) {
    for (std::size_t i = 0; i < FragmentBatch::kCellLanes; ++i) {
      const bool is_discarded = cell < 5 && ((i + cell) % 4 < 2 || (cell == 0 && i == 2));
      EXPECT_EQ(out.discarded[cell] >> i & 1, is_discarded ? 1 : 0) << cell << ' ' << i;
    }
  }
  shader.sampler.filter = Filter::trilinear;
  EXPECT_TRUE(shader.uses_derivatives());
}

}  // namespace
}  // namespace rastercheck::rasterizer::shaders_test
