// The model does what its header says; the expected numbers are worked out by hand.

#include "properties/laws/internal/picture_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

namespace rastercheck::properties::picture_model_test {
namespace {

using cases::Blend;
using cases::ColorFormat;
using cases::DepthFunction;
using cases::Pipeline;
using testing::ElementsAre;

/// A case of one pixel.
cases::Case pixel(std::size_t channels, int samples = 1) {
  cases::Case c;
  c.framebuffer = {1, 1, samples};
  c.attributes.resize(channels);
  return c;
}

void add(cases::Fragments& drawn, std::uint32_t triangle, float depth,
         const std::vector<float>& color, int sample = 0) {
  drawn.attribute_count = color.size();
  drawn.triangle.push_back(triangle);
  drawn.x.push_back(0);
  drawn.y.push_back(0);
  drawn.sample.push_back(static_cast<std::uint8_t>(sample));
  drawn.depth.push_back(depth);
  drawn.attributes.insert(drawn.attributes.end(), color.begin(), color.end());
}

Pipeline always(Blend blend, ColorFormat format = ColorFormat::float32) {
  Pipeline pipeline;
  pipeline.depth_function = DepthFunction::always;
  pipeline.blend = blend;
  pipeline.format = format;
  return pipeline;
}

TEST(PictureModel, ComparesDepths) {
  constexpr std::array kAll{DepthFunction::always,        DepthFunction::never,
                            DepthFunction::less,          DepthFunction::equal,
                            DepthFunction::less_or_equal, DepthFunction::greater,
                            DepthFunction::not_equal,     DepthFunction::greater_or_equal};
  const auto passing = [&](float depth) {
    std::vector<bool> result;
    for (const DepthFunction function : kAll) result.push_back(passes(function, depth, 0.5F));
    return result;
  };
  EXPECT_THAT(passing(0.25F), ElementsAre(true, false, true, false, true, false, true, false));
  EXPECT_THAT(passing(0.5F), ElementsAre(true, false, false, true, true, false, false, true));
  EXPECT_THAT(passing(0.75F), ElementsAre(true, false, false, false, false, true, true, true));
}

TEST(PictureModel, ClearsWhatNothingIsDrawnOn) {
  Pipeline pipeline;
  pipeline.clear_depth = 0.75F;
  cases::Fragments none;
  none.attribute_count = 2;
  const cases::Picture picture = picture_of(pixel(2, 2), none, pipeline);
  EXPECT_EQ(picture.size, (cases::FramebufferSize{1, 1, 2}));
  EXPECT_EQ(picture.channels, 2U);
  EXPECT_THAT(picture.color, ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(picture.depth, ElementsAre(0.75F, 0.75F));
}

TEST(PictureModel, TestsAgainstTheDepthThatWasWritten) {
  cases::Fragments drawn;
  add(drawn, 0, 0.5F, {1});
  add(drawn, 1, 0.75F, {2});
  Pipeline pipeline;
  const cases::Picture nearest = picture_of(pixel(1), drawn, pipeline);
  EXPECT_THAT(nearest.color, ElementsAre(1));
  EXPECT_THAT(nearest.depth, ElementsAre(0.5F));
  pipeline.writes_depth = false;
  const cases::Picture last = picture_of(pixel(1), drawn, pipeline);
  EXPECT_THAT(last.color, ElementsAre(2));
  EXPECT_THAT(last.depth, ElementsAre(1));
}

TEST(PictureModel, DrawsTrianglesInSubmissionOrder) {
  cases::Fragments drawn;
  add(drawn, 1, 0.5F, {2});
  add(drawn, 0, 0.5F, {1});
  EXPECT_THAT(picture_of(pixel(1), drawn, always(Blend::off)).color, ElementsAre(2));
}

TEST(PictureModel, Adds) {
  cases::Fragments drawn;
  for (std::uint32_t t = 0; t < 3; ++t) add(drawn, t, 0.5F, {0.5F, -1});
  EXPECT_THAT(picture_of(pixel(2), drawn, always(Blend::additive)).color, ElementsAre(1.5F, -3));
  // 128/255 is added twice, because 127.5 rounds to the even 128; then the sum is clamped.
  EXPECT_THAT(picture_of(pixel(2), drawn, always(Blend::additive, ColorFormat::rgba8)).color,
              ElementsAre(1, 0));
}

TEST(PictureModel, BlendsOver) {
  cases::Fragments drawn;
  add(drawn, 0, 0.5F, {1, 0.5F, 0, 1});
  add(drawn, 1, 0.5F, {0, 1, 2, 0.25F});
  // Colours become 1/4 s + 3/4 d, and alpha 1/4 + 3/4.
  EXPECT_THAT(picture_of(pixel(4), drawn, always(Blend::over)).color,
              ElementsAre(0.75F, 0.625F, 0.5F, 1));
  // In floats, alpha outside [0, 1] is not clamped: 2 s − d.
  cases::Fragments beyond;
  add(beyond, 0, 0.5F, {1, 1, 1, 1});
  add(beyond, 1, 0.5F, {1, 0.5F, 0, 2});
  EXPECT_THAT(picture_of(pixel(4), beyond, always(Blend::over)).color, ElementsAre(1, 0, -1, 1));
  EXPECT_THAT(picture_of(pixel(4), beyond, always(Blend::over, ColorFormat::rgba8)).color,
              ElementsAre(1, 128 / 255.0F, 0, 1));
}

TEST(PictureModel, HoldsBytes) {
  const auto held = [](float color) {
    cases::Fragments drawn;
    add(drawn, 0, 0.5F, {color});
    return picture_of(pixel(1), drawn, always(Blend::off, ColorFormat::rgba8)).color[0];
  };
  EXPECT_EQ(held(-1), 0);
  EXPECT_EQ(held(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(held(std::numeric_limits<float>::infinity()), 1);
  EXPECT_EQ(held(0.5F), 128 / 255.0F);  // 127.5 rounds to the even 128
  EXPECT_EQ(held(1 / 255.0F), 1 / 255.0F);
  EXPECT_EQ(held(0.49F / 255), 0);
}

TEST(PictureModel, ResolvesToTheMean) {
  cases::Fragments drawn;
  add(drawn, 0, 0.25F, {1}, 0);
  add(drawn, 0, 0.75F, {0.5F}, 1);
  Pipeline pipeline = always(Blend::off);
  pipeline.resolves = true;
  const cases::Picture floats = picture_of(pixel(1, 2), drawn, pipeline);
  EXPECT_EQ(floats.size, (cases::FramebufferSize{1, 1, 1}));
  EXPECT_THAT(floats.color, ElementsAre(0.75F));
  EXPECT_THAT(floats.depth, ElementsAre(0.25F));
  // (255 + 128)/2 = 191.5 rounds to 192.
  pipeline.format = ColorFormat::rgba8;
  EXPECT_THAT(picture_of(pixel(1, 2), drawn, pipeline).color, ElementsAre(192 / 255.0F));
}

TEST(PictureModel, RoundsEveryOperationToDouble) {
  // s + d = 1 + 2^-24 + 2^-60: a double drops the 2^-60, and the float is then a tie that rounds to
  // 1.
  cases::Fragments drawn;
  add(drawn, 0, 0.5F, {1});
  add(drawn, 1, 0.5F, {0x1.000002p-24F});
  EXPECT_THAT(picture_of(pixel(1), drawn, always(Blend::additive)).color,
              ElementsAre(1 + 0x1p-23F));
  cases::Fragments tied;
  add(tied, 0, 0.5F, {0x1p-60F});
  add(tied, 1, 0.5F, {0x1p-24F});
  add(tied, 2, 0.5F, {1});
  EXPECT_THAT(picture_of(pixel(1), tied, always(Blend::additive)).color, ElementsAre(1));
}

TEST(PictureModel, LeavesOutWhatIsNowhere) {
  cases::Fragments drawn;
  add(drawn, 0, 0.5F, {1}, 1);
  drawn.x[0] = 7;
  EXPECT_THAT(picture_of(pixel(1), drawn, always(Blend::off)).color, ElementsAre(0));
}

TEST(PictureModel, TakesVertexColoursForTheFirstFourAttributes) {
  Pipeline pipeline = always(Blend::over);
  pipeline.shading = cases::Shading::vertex_colors;
  cases::Fragments five;
  add(five, 0, 0.5F, {0.5F, 1, 0.25F, 0.5F, 8});
  const cases::Picture picture = picture_of(pixel(5), five, pipeline);
  EXPECT_EQ(picture.channels, 4U);
  EXPECT_THAT(picture.color, ElementsAre(0.25F, 0.5F, 0.125F, 0.5F));
}

TEST(PictureModel, GivesThreeVertexColoursAnAlphaOfOne) {
  for (const ColorFormat format : {ColorFormat::float32, ColorFormat::rgba8}) {
    for (const Blend blend : {Blend::off, Blend::over, Blend::additive}) {
      Pipeline pipeline = always(blend, format);
      pipeline.shading = cases::Shading::vertex_colors;
      cases::Fragments three;
      add(three, 0, 0.5F, {0, 1, 0.2F});
      EXPECT_THAT(picture_of(pixel(3), three, pipeline).color, ElementsAre(0, 1, 0.2F, 1));
    }
  }
}

cases::PictureBounds bounds_of(float float_error, float byte_store, float byte_blend) {
  cases::PictureBounds bounds;
  bounds.float_error = float_error;
  bounds.byte_store = byte_store;
  bounds.byte_blend = byte_blend;
  return bounds;
}

TEST(PictureRange, OfFloatsGrowsWithTheSizesOfTheirTerms) {
  cases::Fragments drawn;
  add(drawn, 0, 0.5F, {1});
  add(drawn, 1, 0.5F, {-0.5F});
  const PictureRange range =
      range_of(pixel(1), drawn, always(Blend::additive), bounds_of(0x1p4F, 0, 0));
  // 1 is off by 2^-20; the sum's terms are 1 + 2^-20 and 0.5, so it is off by 1.5 · 2^-20 more.
  EXPECT_NEAR(range.least.color[0], 0.5F - 2.5F * 0x1p-20F, 0x1p-24F);
  EXPECT_NEAR(range.greatest.color[0], 0.5F + 2.5F * 0x1p-20F, 0x1p-24F);
  EXPECT_TRUE(range.has_color(0, 0.5F));
  EXPECT_FALSE(range.has_color(0, 0.5F + 3 * 0x1p-20F));
  EXPECT_FALSE(range.has_color(0, std::numeric_limits<float>::quiet_NaN()));
}

TEST(PictureRange, OfBytesHasTheBytesWithinReach) {
  cases::Fragments drawn;
  add(drawn, 0, 0.5F, {0.5F, 0, 1, 0.25F});  // 127.5, 0, 255 and 63.75 steps
  const auto bytes = [&](float reach) {
    const PictureRange range =
        range_of(pixel(4), drawn, always(Blend::off, ColorFormat::rgba8), bounds_of(0, reach, 0));
    std::vector<float> ends;
    for (std::size_t k = 0; k < 4; ++k) {
      ends.push_back(range.least.color[k] * 255);
      ends.push_back(range.greatest.color[k] * 255);
    }
    return ends;
  };
  EXPECT_THAT(bytes(0.5F), ElementsAre(127, 128, 0, 0, 255, 255, 64, 64));
  EXPECT_THAT(bytes(1), ElementsAre(127, 128, 0, 1, 254, 255, 63, 64));
}

TEST(PictureRange, OfABlendTakesInAllThatMayBePresent) {
  cases::Fragments drawn;
  add(drawn, 0, 0.5F, {1, 1, 1, 1});
  add(drawn, 1, 0.5F, {0, 0, 0, 0.5F});
  const PictureRange range =
      range_of(pixel(4), drawn, always(Blend::over, ColorFormat::rgba8), bounds_of(0, 0.5F, 2));
  // First 253 to 255, of 255 over 0 with alpha 1; then half of that, off by 2.
  EXPECT_EQ(range.least.color[0] * 255, 125);
  EXPECT_EQ(range.greatest.color[0] * 255, 129);
}

TEST(PictureRange, OfAResolveIsTheMeanOrAllSamples) {
  cases::Fragments drawn;
  for (int sample = 0; sample < 4; ++sample) {
    add(drawn, 0, 0.5F, {static_cast<float>(sample)}, sample);
  }
  Pipeline resolved = always(Blend::off);
  resolved.resolves = true;
  cases::PictureBounds bounds;
  const PictureRange mean = range_of(pixel(1, 4), drawn, resolved, bounds);
  EXPECT_EQ(mean.least.color[0], 1.5F);
  EXPECT_EQ(mean.greatest.color[0], 1.5F);
  bounds.resolves_to_mean = false;
  const PictureRange any = range_of(pixel(1, 4), drawn, resolved, bounds);
  EXPECT_EQ(any.least.color[0], 0);
  EXPECT_EQ(any.greatest.color[0], 3);
}

}  // namespace
}  // namespace rastercheck::properties::picture_model_test
