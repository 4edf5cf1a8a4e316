#include <gtest/gtest.h>

#include "backends/vulkan/limits.h"

namespace rastercheck::backends::vulkan::vulkan_limits_test {
namespace {

using cases::Interpolation;
using cases::Location;

/// The limits that lavapipe reports, except that viewports may begin at half pixels.
Limits all() {
  Limits limits;
  limits.max_width = 8192;
  limits.max_height = 4096;
  limits.sample_counts = 1U | 4U;
  limits.standard_sample_locations = true;
  limits.max_viewport = {16384, 16384};
  limits.viewport_bounds = {-32768, 32767};
  limits.viewport_subpixel_bits = 1;
  limits.subpixel_bits = 8;
  limits.clip_distances = 8;
  limits.sample_rate_shading = true;
  limits.depth_clamp = true;
  limits.depth_bias_clamp = true;
  limits.unorm16_samples = limits.unorm24_samples = 1U | 4U;
  limits.depth_clip_control = true;
  limits.provoking_vertex_last = true;
  limits.slots = 7;
  limits.float_blending = true;
  limits.byte_samples = 1U | 4U;
  limits.max_texture = 8192;
  limits.line_widths = {1, 255, 1};
  limits.point_sizes = {0, 255, 0.125F};
  limits.strict_lines = limits.rectangular_lines = limits.bresenham_lines = true;
  return limits;
}

cases::Case ordinary() {
  cases::Case c;
  c.framebuffer = {64, 64, 4};
  c.viewport = {-3, 64, 32.5F, -64, 1, 0};
  c.depth_clamp = true;
  c.clip_distance_count = 8;
  c.attributes = {{"u", Interpolation::smooth, Location::sample}, {"f", Interpolation::flat, {}}};
  return c;
}

TEST(VulkanLimits, LeaveOrdinaryCasesAlone) {
  EXPECT_EQ(lacks(all(), ordinary()), "");
  cases::Case c = ordinary();
  c.rules = cases::Rules::opengl;
  EXPECT_EQ(lacks(all(), c), "");
}

TEST(VulkanLimits, AreOfDepths) {
  cases::Case c = ordinary();
  c.depth_format = cases::DepthFormat::unorm24;
  c.depth_bias = {1, 2, 3};
  EXPECT_EQ(lacks(all(), c), "");
  EXPECT_TRUE(drawable(all()).has(cases::Feature::unorm_depth));
  Limits limits = all();
  limits.unorm24_samples = 1;
  EXPECT_EQ(lacks(limits, c), "4 samples per pixel of unorm24");
  limits.unorm24_samples = 0;
  EXPECT_EQ(lacks(limits, c), "the depth format unorm24");
  c.depth_format = cases::DepthFormat::unorm16;
  EXPECT_EQ(lacks(limits, c), "");
  EXPECT_TRUE(drawable(limits).has(cases::Feature::unorm_depth));
  limits.unorm16_samples = 0;
  EXPECT_FALSE(drawable(limits).has(cases::Feature::unorm_depth));
  EXPECT_TRUE(drawable(limits).has(cases::Feature::depth_bias));
  limits.unorm16_samples = 4;
  limits.depth_bias_clamp = false;
  EXPECT_EQ(lacks(limits, c), "a clamp of the depth bias (depthBiasClamp)");
  c.depth_bias = {0, 0, 3};
  EXPECT_EQ(lacks(limits, c), "");
}

TEST(VulkanLimits, AreOfSizesAndSamples) {
  cases::Case c = ordinary();
  c.framebuffer = {8192, 4096, 1};
  EXPECT_EQ(lacks(all(), c), "");
  c.framebuffer = {8193, 4096, 1};
  EXPECT_EQ(lacks(all(), c), "framebuffers of 8193 x 4096 pixels: 8192 x 4096 at most");
  c.framebuffer = {64, 4097, 1};
  EXPECT_EQ(lacks(all(), c), "framebuffers of 64 x 4097 pixels: 8192 x 4096 at most");
  c.framebuffer = {64, 64, 8};
  EXPECT_EQ(lacks(all(), c), "8 samples per pixel");
  Limits limits = all();
  limits.standard_sample_locations = false;
  EXPECT_EQ(lacks(limits, ordinary()), "the standard sample locations (standardSampleLocations)");
  c.framebuffer.samples = 1;
  EXPECT_EQ(lacks(limits, c), "");
}

TEST(VulkanLimits, AreOfViewports) {
  cases::Case c = ordinary();
  for (const float width : {0.0F, -64.0F}) {
    c.viewport.width = width;
    EXPECT_EQ(lacks(all(), c), "viewports without a positive width");
  }
  c.viewport = {0, 0, 16384.5F, 64};
  EXPECT_EQ(lacks(all(), c), "viewports beyond 16384 x 16384 pixels (maxViewportDimensions)");
  c.viewport = {0, 0, 64, -16385};
  EXPECT_EQ(lacks(all(), c), "viewports beyond 16384 x 16384 pixels (maxViewportDimensions)");
  for (const cases::Viewport& beyond : {cases::Viewport{-32769, 0, 64, 64},
                                        {32700, 0, 68, 64},
                                        {0, -32760, 64, -9},
                                        {0, 32768, 64, -64}}) {
    c.viewport = beyond;
    EXPECT_EQ(lacks(all(), c), "viewports beyond -32768 to 32767 (viewportBoundsRange)");
  }
  // Viewports with fractions are drawn. The contract, not a limit, says how precisely.
  for (const cases::Viewport& fine : {cases::Viewport{0.5F, 0, 64, 64}, {0, 0, 64, -63.75F}}) {
    c.viewport = fine;
    EXPECT_EQ(lacks(all(), c), "");
  }
}

TEST(VulkanLimits, AreOfFeatures) {
  Limits limits = all();
  limits.depth_clamp = false;
  EXPECT_EQ(lacks(limits, ordinary()), "depth clamp (depthClamp)");
  limits = all();
  limits.clip_distances = 7;
  EXPECT_EQ(lacks(limits, ordinary()), "8 clip distances");
  limits = all();
  limits.sample_rate_shading = false;
  cases::Case c = ordinary();
  for (const Location location : {Location::sample, Location::center}) {
    c.attributes[0].location = location;
    EXPECT_EQ(lacks(limits, c),
              "attributes at samples and centres of several samples (sampleRateShading)");
  }
  c.attributes[0].location = Location::centroid;
  EXPECT_EQ(lacks(limits, c), "");
  c.attributes[0].location = Location::sample;
  c.framebuffer.samples = 1;
  EXPECT_EQ(lacks(limits, c), "");
}

TEST(VulkanLimits, AreOfRules) {
  cases::Case c = ordinary();
  c.rules = cases::Rules::d3d;
  EXPECT_EQ(lacks(all(), c), "the rules of D3D");
  c.rules = cases::Rules::opengl;
  Limits limits = all();
  limits.provoking_vertex_last = false;
  EXPECT_EQ(lacks(limits, c), "OpenGL's provoking vertex (VK_EXT_provoking_vertex)");
  c.attributes.pop_back();
  EXPECT_EQ(lacks(limits, c), "");
  limits.depth_clip_control = false;
  EXPECT_EQ(lacks(limits, c), "OpenGL's clip depth (VK_EXT_depth_clip_control)");
  c.rules = cases::Rules::vulkan;
  EXPECT_EQ(lacks(limits, c), "");
}

TEST(VulkanLimits, AreOfLines) {
  cases::Case c = ordinary();
  c.primitive = cases::Primitive::lines;
  c.line_width = 255;
  EXPECT_EQ(lacks(all(), c), "");
  for (const auto& [width, reason] :
       {std::pair(2.5F,
                  "lines of width 2.5: 1 to 255 in steps of 1 (lineWidthRange, "
                  "lineWidthGranularity)"),
        std::pair(256.0F,
                  "lines of width 256: 1 to 255 in steps of 1 (lineWidthRange, "
                  "lineWidthGranularity)")}) {
    c.line_width = width;
    EXPECT_EQ(lacks(all(), c), reason);
  }
  Limits limits = all();
  limits.line_widths = {};
  EXPECT_EQ(lacks(limits, c), "lines of width 256 (wideLines)");
  c.line_width = 1;
  EXPECT_EQ(lacks(limits, c), "");

  // Lines of the default mode are rectangles if and only if they are strict.
  limits.rectangular_lines = false;
  EXPECT_EQ(lacks(limits, c), "");
  c.line_mode = cases::LineMode::parallelogram;
  EXPECT_EQ(lacks(limits, c),
            "lines that are parallelograms: its default mode has rectangles (strictLines)");
  limits.strict_lines = false;
  EXPECT_EQ(lacks(limits, c), "");
  c.line_mode = cases::LineMode::rectangular;
  EXPECT_EQ(lacks(limits, c), "rectangular lines (rectangularLines, strictLines)");
  c.line_mode = cases::LineMode::bresenham;
  EXPECT_EQ(lacks(limits, c), "");
  limits.bresenham_lines = false;
  EXPECT_EQ(lacks(limits, c), "Bresenham's lines (bresenhamLines)");
}

TEST(VulkanLimits, AreOfPoints) {
  cases::Case c = ordinary();
  c.primitive = cases::Primitive::points;
  c.point_size = 0.125F;
  EXPECT_EQ(lacks(all(), c), "");
  c.point_size = 0.1F;
  EXPECT_EQ(
      lacks(all(), c),
      "points of size 0.1: 0 to 255 in steps of 0.125 (pointSizeRange, pointSizeGranularity)");
  Limits limits = all();
  limits.point_sizes = {};
  EXPECT_EQ(lacks(limits, c), "points of size 0.1 (largePoints)");
  // A point's only vertex is the first and the last.
  c.point_size = 1;
  c.rules = cases::Rules::opengl;
  limits.provoking_vertex_last = false;
  EXPECT_EQ(lacks(limits, c), "");
}

TEST(VulkanLimits, AreOfPictures) {
  const cases::Case c = ordinary();
  cases::Pipeline pipeline;
  pipeline.blend = cases::Blend::additive;
  pipeline.texturing.emplace();
  pipeline.texturing->texture = {8192, 1, {}};
  EXPECT_EQ(lacks_for_picture(all(), c, pipeline), "");
  Limits limits = all();
  limits.max_texture = 4096;
  EXPECT_EQ(lacks_for_picture(limits, c, pipeline),
            "textures of 8192 x 1 texels: 4096 at most (maxImageDimension2D)");
  limits.float_blending = false;
  EXPECT_EQ(lacks_for_picture(limits, c, pipeline),
            "blending of float32 colours (VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT)");
  pipeline.texturing.reset();
  pipeline.blend = cases::Blend::off;
  EXPECT_EQ(lacks_for_picture(limits, c, pipeline), "");
  pipeline.format = cases::ColorFormat::rgba8;
  EXPECT_EQ(lacks_for_picture(limits, c, pipeline), "");
  limits.byte_samples = 1;
  EXPECT_EQ(lacks_for_picture(limits, c, pipeline), "4 samples per pixel of rgba8");
  pipeline.clear_depth = -0.5F;
  EXPECT_EQ(lacks_for_picture(limits, c, pipeline), "the initial depth -0.5: 0 to 1");
}

}  // namespace
}  // namespace rastercheck::backends::vulkan::vulkan_limits_test
