#include "backends/gl/internal/capabilities.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace rastercheck::backends::gl::capabilities_test {
namespace {

using cases::Interpolation;
using cases::Location;
using testing::HasSubstr;

/// A triangle with one attribute and one clip distance.
cases::Case small_case() {
  cases::Case c;
  c.rules = cases::Rules::opengl;
  c.framebuffer = {8, 8, 1};
  c.viewport = {0, 0, 8, 8, 0, 1};
  c.attributes = {{"a", Interpolation::smooth, Location::sample}};
  c.positions = {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}};
  c.attribute_values = {20, 21, 22};
  c.clip_distance_count = 1;
  c.clip_distances = {30, 31, 32};
  c.triangles = {{2, 0, 1}};
  return c;
}

Capabilities all_there() {
  Capabilities has;
  has.api = "OpenGL 4.6";
  has.has_clip_control = has.has_provoking_vertex = has.has_depth_clamp = true;
  has.has_bias_clamp = has.has_unorm_depth = true;
  has.has_noperspective = has.has_sample_qualifier = has.has_sample_targets = true;
  has.has_viewport_fractions = has.clears_beyond_one = true;
  has.has_fine_derivatives = has.has_float_blend = true;
  has.viewport_subpixel_bits = 8;
  has.max_clip_distances = 8;
  has.max_draw_buffers = 8;
  has.max_size = 16384;
  has.max_samples = 16;
  has.viewport_bounds = {-32768, 32767};
  has.max_viewport = {16384, 16384};
  has.line_widths = {1, 10, 0};
  has.multisampled_line_widths = {0.5F, 10, 0.1F};
  has.point_sizes = {1, 64, 0.125F};
  return has;
}

TEST(Capabilities, SufficeForAPlainCase) { EXPECT_EQ(lacks(all_there(), small_case()), ""); }

TEST(Capabilities, NameWhatIsLacking) {
  const auto expect = [](const Capabilities& has, const cases::Case& c, const std::string& what) {
    EXPECT_THAT(lacks(has, c), HasSubstr(what));
  };
  const Capabilities has = all_there();
  cases::Case c = small_case();
  c.rules = cases::Rules::d3d;
  expect(has, c, "the rules of d3d");
  c = small_case();
  c.viewport.height = -8;
  expect(has, c, "negative size");
  c = small_case();
  c.viewport.x = 0x1p-9F;
  EXPECT_EQ(lacks(has, c), "");
  c = small_case();
  c.viewport.y = 40000;
  expect(has, c, "begins at 40000");
  c.viewport = {0, 0, 20000, 8, 0, 1};
  expect(has, c, "20000 x 8");
  c = small_case();
  c.framebuffer.width = 16384;
  c.framebuffer.samples = 4;
  expect(has, c, "a target of 16384 x 8 pixels with 4 samples");
}

TEST(Capabilities, NameWhatThisContextLacks) {
  const auto expect = [](bool Capabilities::*what, const cases::Case& c, const std::string& text) {
    Capabilities has = all_there();
    has.*what = false;
    EXPECT_THAT(lacks(has, c), HasSubstr(text));
    EXPECT_EQ(lacks(has, small_case()), "") << text;
    EXPECT_EQ(lacks(all_there(), c), "") << text;
  };
  cases::Case c = small_case();
  c.rules = cases::Rules::vulkan;
  expect(&Capabilities::has_clip_control, c, "no clip control");
  c.attributes[0].interpolation = Interpolation::flat;
  expect(&Capabilities::has_provoking_vertex, c, "from the last vertex");
  c = small_case();
  c.attributes[0].interpolation = Interpolation::noperspective;
  expect(&Capabilities::has_noperspective, c, "OpenGL 4.6 does not support noperspective");
  c = small_case();
  c.framebuffer.samples = 4;
  expect(&Capabilities::has_sample_qualifier, c, "neither the qualifier `sample`");
  c.attributes[0].location = Location::center;
  expect(&Capabilities::has_sample_qualifier, c, "nor interpolateAtOffset()");
  expect(&Capabilities::has_sample_targets, c, "no arrays of multisampled textures");
  c = small_case();
  c.depth_clamp = true;
  expect(&Capabilities::has_depth_clamp, c, "no depth clamp");
  c = small_case();
  c.depth_bias = {1, 0, 0.5F};
  expect(&Capabilities::has_bias_clamp, c, "no clamp of the depth bias");
  c = small_case();
  c.depth_format = cases::DepthFormat::unorm16;
  expect(&Capabilities::has_unorm_depth, c, "how many bits its depth images have");
  c = small_case();
  c.viewport.x = 0.5F;
  expect(&Capabilities::has_viewport_fractions, c, "does not support fractional viewports");
}

// Lines of one sample have a whole width, at least 1, to which others are rounded.
TEST(Capabilities, NameTheLinesThatAreLacking) {
  const Capabilities has = all_there();
  cases::Case c = small_case();
  c.primitive = cases::Primitive::lines;
  c.line_mode = cases::LineMode::bresenham;
  for (const float width : {0.25F, 1.0F, 2.5F, 10.4F}) {
    c.line_width = width;
    EXPECT_EQ(lacks(has, c), "");
  }
  c.line_width = 11;
  EXPECT_EQ(lacks(has, c), "OpenGL 4.6 draws lines of width 1 to 10; the case needs 11");
  c.line_mode = cases::LineMode::rectangular;
  EXPECT_THAT(lacks(has, c), HasSubstr("bresenham with one sample"));
  c.framebuffer.samples = 4;
  c.line_width = 9.6F;
  EXPECT_EQ(lacks(has, c), "");
  c.line_width = 0.25F;
  EXPECT_EQ(lacks(has, c),
            "OpenGL 4.6 draws lines of width 0.5 to 10 in steps of 0.1; the case needs 0.25");
  c.line_mode = cases::LineMode::bresenham;
  EXPECT_THAT(lacks(has, c), HasSubstr("rectangular with several samples"));
}

TEST(Capabilities, NameThePointsThatAreLacking) {
  Capabilities has = all_there();
  cases::Case c = small_case();
  c.primitive = cases::Primitive::points;
  c.point_size = 2.625F;
  EXPECT_EQ(lacks(has, c), "");
  c.point_size = 2.7F;
  EXPECT_EQ(lacks(has, c),
            "OpenGL 4.6 draws points of size 1 to 64 in steps of 0.125; the case needs 2.7");
  // A point's only vertex is the first and the last.
  c.point_size = 1;
  c.rules = cases::Rules::vulkan;
  c.attributes[0].interpolation = Interpolation::flat;
  has.has_provoking_vertex = false;
  EXPECT_EQ(lacks(has, c), "");
}

TEST(Capabilities, NameWhatAPictureLacks) {
  const cases::Case c = small_case();
  cases::Pipeline pipeline;
  const auto expect = [&](const Capabilities& has, const std::string& what) {
    EXPECT_EQ(lacks(all_there(), c, pipeline, 4), "");
    EXPECT_THAT(lacks(has, c, pipeline, 4), HasSubstr(what));
  };
  Capabilities has = all_there();
  has.has_float_blend = false;
  EXPECT_EQ(lacks(has, c, pipeline, 4), "");
  pipeline.blend = cases::Blend::additive;
  expect(has, "does not blend into float32 targets");
  pipeline.format = cases::ColorFormat::rgba8;
  EXPECT_EQ(lacks(has, c, pipeline, 4), "");
  pipeline = {};
  pipeline.shading = cases::Shading::differences_along_y;
  has = all_there();
  has.has_fine_derivatives = false;
  expect(has, "no dFdxFine() and dFdyFine()");
  pipeline = {};
  pipeline.clear_depth = 2;
  has = all_there();
  has.clears_beyond_one = false;
  expect(has, "cannot be cleared to 2");
  pipeline = {};
  pipeline.texturing.emplace().texture = {16384, 1, {}};
  has = all_there();
  has.max_size = 4096;
  expect(has, "texture of 16384 x 1 texels");
}

TEST(Capabilities, CountThePicturesChannels) {
  const Capabilities has = all_there();
  cases::Case c = small_case();
  EXPECT_EQ(lacks(has, c, {}, 32), "");
  EXPECT_THAT(lacks(has, c, {}, 33), HasSubstr("at most 32 channels here; the case needs 33"));
  c.framebuffer.samples = 4;
  EXPECT_EQ(lacks(has, c, {}, 28), "");
  EXPECT_THAT(lacks(has, c, {}, 29), HasSubstr("at most 28 channels"));
}

TEST(Capabilities, CountSamplesAndClipDistances) {
  Capabilities has = all_there();
  has.max_samples = 4;
  has.max_clip_distances = 0;
  cases::Case c = small_case();
  EXPECT_THAT(lacks(has, c), HasSubstr("has 0 clip distances; the case needs 1"));
  has.max_clip_distances = 8;
  c.framebuffer.samples = 8;
  EXPECT_THAT(lacks(has, c), HasSubstr("at most 4 samples; the case needs 8"));
}

}  // namespace
}  // namespace rastercheck::backends::gl::capabilities_test
