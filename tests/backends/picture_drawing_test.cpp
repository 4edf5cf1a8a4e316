#include "backends/plugin/picture_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.h"

namespace rastercheck::backends::picture_drawing_test {
namespace {

cases::Case small_case() {
  cases::Case c;
  c.framebuffer = {2, 3, 2};
  c.viewport.width = 2;
  c.viewport.height = 3;
  c.depth_test = cases::DepthTest::less;
  c.attributes = {{"s"}, {"t"}, {"u"}};
  c.positions = {{0, 0, 0, 1}, {1, 0, 1, 1}, {0, 1, 0.5F, 1}};
  c.attribute_values = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  c.triangles = {{0, 1, 2}, {2, 1, 0}};
  return c;
}

using DrawPicture = std::function<std::uint32_t(const rastercheck_draw&,
                                                const rastercheck_pipeline&, rastercheck_picture&)>;

/// What the plugin's function, which is a pointer, calls.
DrawPicture& body() {
  static DrawPicture function;
  return function;
}

std::uint32_t call_body(const rastercheck_draw* draw, const rastercheck_pipeline* pipeline,
                        rastercheck_picture* picture) {
  return body()(*draw, *pipeline, *picture);
}

Plugin plugin_with(DrawPicture function) {
  body() = std::move(function);
  Plugin plugin{"mine", "1", {}, nullptr};
  plugin.draw_picture = &call_body;
  return plugin;
}

std::size_t samples_in(const rastercheck_picture& picture) {
  return std::size_t{picture.width} * picture.height * picture.samples;
}

void fill(const rastercheck_picture& picture, float color, float depth) {
  std::fill_n(picture.color, samples_in(picture) * picture.channels, color);
  std::fill_n(picture.depth, samples_in(picture), depth);
}

/// What is said of a plugin that draws the picture in this way; empty if nothing is.
std::string said_of(DrawPicture function, const cases::Pipeline& pipeline = {}) {
  const Plugin plugin = plugin_with(std::move(function));
  PictureDrawing drawing("x.so");
  const auto picture = drawing.draw(plugin, small_case(), pipeline);
  return picture ? "" : to_string(picture.error());
}

TEST(PictureDrawing, HandsOverTheCase) {
  const Plugin plugin = plugin_with([](const rastercheck_draw& draw, const rastercheck_pipeline&,
                                       rastercheck_picture& picture) -> std::uint32_t {
    EXPECT_EQ(draw.size, sizeof draw);
    EXPECT_EQ(draw.samples, 2U);
    EXPECT_EQ(draw.depth_test, 0U);  // the pipeline has a depth function
    EXPECT_EQ(draw.vertex_count, 3U);
    EXPECT_EQ(draw.positions[4], 1.0F);
    EXPECT_EQ(draw.attribute_count, 3U);
    EXPECT_EQ(draw.attribute_values[8], 9.0F);
    EXPECT_EQ(draw.triangle_count, 2U);
    EXPECT_EQ(std::vector(draw.indices, draw.indices + 6),
              (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0}));
    EXPECT_EQ(picture.size, sizeof picture);
    EXPECT_EQ((std::array{picture.width, picture.height, picture.samples, picture.channels}),
              (std::array{2U, 3U, 2U, 3U}));
    fill(picture, 0.25F, 0.5F);
    picture.color[7] = 2;
    picture.depth[3] = 1;
    return RASTERCHECK_OK;
  });
  PictureDrawing drawing("x.so");
  const auto picture = drawing.draw(plugin, small_case(), {});
  ASSERT_TRUE(picture) << to_string(picture.error());
  EXPECT_EQ(picture->size, (cases::FramebufferSize{2, 3, 2}));
  EXPECT_EQ(picture->channels, 3U);
  std::vector<float> color(36, 0.25F);
  color[7] = 2;
  std::vector<float> depth(12, 0.5F);
  depth[3] = 1;
  EXPECT_EQ(picture->color, color);
  EXPECT_EQ(picture->depth, depth);
}

// Kills: an enumerator of a pipeline handed over as another one.
TEST(PictureDrawing, HandsOverThePipeline) {
  const auto handed_over = [](const cases::Pipeline& pipeline) {
    rastercheck_pipeline seen{};
    EXPECT_EQ(said_of(
                  [&seen](const rastercheck_draw&, const rastercheck_pipeline& handed,
                          rastercheck_picture& picture) -> std::uint32_t {
                    seen = handed;
                    fill(picture, 0, 0);
                    return RASTERCHECK_OK;
                  },
                  pipeline),
              "");
    EXPECT_EQ(seen.size, sizeof seen);
    EXPECT_EQ(seen.texture, nullptr);
    return seen;
  };
  cases::Pipeline pipeline;
  pipeline.clear_depth = 0.75F;
  EXPECT_EQ(handed_over(pipeline).clear_depth, 0.75F);
  EXPECT_EQ(handed_over(pipeline).writes_depth, 1U);
  EXPECT_EQ(handed_over(pipeline).resolves, 0U);
  pipeline.writes_depth = false;
  pipeline.resolves = true;
  EXPECT_EQ(handed_over(pipeline).writes_depth, 0U);
  EXPECT_EQ(handed_over(pipeline).resolves, 1U);
  using cases::DepthFunction;
  for (const auto& [function, handed] :
       {std::pair(DepthFunction::always, RASTERCHECK_COMPARE_ALWAYS),
        std::pair(DepthFunction::never, RASTERCHECK_COMPARE_NEVER),
        std::pair(DepthFunction::less, RASTERCHECK_COMPARE_LESS),
        std::pair(DepthFunction::equal, RASTERCHECK_COMPARE_EQUAL),
        std::pair(DepthFunction::less_or_equal, RASTERCHECK_COMPARE_LESS_OR_EQUAL),
        std::pair(DepthFunction::greater, RASTERCHECK_COMPARE_GREATER),
        std::pair(DepthFunction::not_equal, RASTERCHECK_COMPARE_NOT_EQUAL),
        std::pair(DepthFunction::greater_or_equal, RASTERCHECK_COMPARE_GREATER_OR_EQUAL)}) {
    pipeline.depth_function = function;
    EXPECT_EQ(handed_over(pipeline).depth_function, std::uint32_t{handed});
  }
  for (const auto& [blend, handed] :
       {std::pair(cases::Blend::off, RASTERCHECK_BLEND_OFF),
        std::pair(cases::Blend::over, RASTERCHECK_BLEND_OVER),
        std::pair(cases::Blend::additive, RASTERCHECK_BLEND_ADDITIVE)}) {
    pipeline.blend = blend;
    EXPECT_EQ(handed_over(pipeline).blend, std::uint32_t{handed});
  }
  for (const auto& [format, handed] :
       {std::pair(cases::ColorFormat::float32, RASTERCHECK_COLOR_FLOAT32),
        std::pair(cases::ColorFormat::rgba8, RASTERCHECK_COLOR_RGBA8)}) {
    pipeline.format = format;
    EXPECT_EQ(handed_over(pipeline).format, std::uint32_t{handed});
  }
  for (const auto& [shading, handed] :
       {std::pair(cases::Shading::attributes, RASTERCHECK_SHADING_ATTRIBUTES),
        std::pair(cases::Shading::vertex_colors, RASTERCHECK_SHADING_VERTEX_COLORS),
        std::pair(cases::Shading::differences_along_x, RASTERCHECK_SHADING_DIFFERENCES_X),
        std::pair(cases::Shading::differences_along_y, RASTERCHECK_SHADING_DIFFERENCES_Y),
        std::pair(cases::Shading::facing, RASTERCHECK_SHADING_FACING),
        std::pair(cases::Shading::window_coordinates, RASTERCHECK_SHADING_WINDOW_COORDINATES)}) {
    pipeline.shading = shading;
    EXPECT_EQ(handed_over(pipeline).shading, std::uint32_t{handed});
  }
  EXPECT_EQ(handed_over(pipeline).discard_below, -std::numeric_limits<float>::infinity());
  pipeline.discard_below = 0.5F;
  EXPECT_EQ(handed_over(pipeline).discard_below, 0.5F);
}

// Kills: an enumerator of a texture handed over as another one; a texture with attributes as
// channels.
TEST(PictureDrawing, HandsOverTheTexture) {
  std::vector<std::uint8_t> texels;
  rastercheck_texture seen{};
  std::uint32_t channels = 0;
  const auto hand_over = [&](const cases::Pipeline& pipeline) {
    EXPECT_EQ(said_of(
                  [&](const rastercheck_draw&, const rastercheck_pipeline& handed,
                      rastercheck_picture& picture) -> std::uint32_t {
                    seen = *handed.texture;
                    texels.assign(seen.texels,
                                  seen.texels + std::size_t{seen.width} * seen.height * 4);
                    channels = picture.channels;
                    fill(picture, 0, 0);
                    return RASTERCHECK_OK;
                  },
                  pipeline),
              "");
  };
  cases::Pipeline pipeline;
  pipeline.texturing.emplace().texture = {1, 2, {1, 2, 3, 4, 5, 6, 7, 8}};
  hand_over(pipeline);
  EXPECT_EQ(seen.size, sizeof seen);
  EXPECT_EQ(texels, pipeline.texturing->texture.texels);
  EXPECT_EQ((std::array{seen.width, seen.height, channels}), (std::array{1U, 2U, 4U}));
  pipeline.texturing->wrap_s = cases::Wrap::clamp;
  pipeline.texturing->wrap_t = cases::Wrap::mirror;
  pipeline.texturing->filter = cases::Filter::bilinear;
  hand_over(pipeline);
  EXPECT_EQ(seen.wrap_s, std::uint32_t{RASTERCHECK_WRAP_CLAMP});
  EXPECT_EQ(seen.wrap_t, std::uint32_t{RASTERCHECK_WRAP_MIRROR});
  EXPECT_EQ(seen.filter, std::uint32_t{RASTERCHECK_FILTER_BILINEAR});
  pipeline.texturing->wrap_s = cases::Wrap::repeat;
  pipeline.texturing->filter = cases::Filter::trilinear;
  hand_over(pipeline);
  EXPECT_EQ(seen.wrap_s, std::uint32_t{RASTERCHECK_WRAP_REPEAT});
  EXPECT_EQ(seen.filter, std::uint32_t{RASTERCHECK_FILTER_TRILINEAR});
  pipeline.texturing->filter = cases::Filter::nearest;
  hand_over(pipeline);
  EXPECT_EQ(seen.filter, std::uint32_t{RASTERCHECK_FILTER_NEAREST});
}

TEST(PictureDrawing, TakesOneSampleIfResolved) {
  cases::Pipeline pipeline;
  pipeline.resolves = true;
  pipeline.shading = cases::Shading::vertex_colors;
  const Plugin plugin = plugin_with([](const rastercheck_draw& draw, const rastercheck_pipeline&,
                                       rastercheck_picture& picture) -> std::uint32_t {
    EXPECT_EQ(draw.samples, 2U);
    fill(picture, 1, 1);
    return RASTERCHECK_OK;
  });
  PictureDrawing drawing("x.so");
  const auto picture = drawing.draw(plugin, small_case(), pipeline);
  ASSERT_TRUE(picture) << to_string(picture.error());
  EXPECT_EQ(picture->size, (cases::FramebufferSize{2, 3, 1}));
  EXPECT_EQ(picture->color.size(), 6U * 4U);
  EXPECT_EQ(picture->depth.size(), 6U);
}

// Kills: samples that a plugin left as they were, taken for drawn; bytes that are none.
TEST(PictureDrawing, SaysWhichNumberIsWrong) {
  cases::Pipeline bytes;
  bytes.format = cases::ColorFormat::rgba8;
  const auto with = [](auto change) {
    return [change](const rastercheck_draw&, const rastercheck_pipeline&,
                    rastercheck_picture& picture) -> std::uint32_t {
      const float unwritten = picture.color[0];
      fill(picture, 1, 1);
      change(picture, unwritten);
      return RASTERCHECK_OK;
    };
  };
  EXPECT_EQ(said_of([](const auto&...) -> std::uint32_t { return RASTERCHECK_OK; }),
            "plugin:x.so: draw_picture() wrote nothing to picture->depth (pixel 0, 0, sample 0)");
  EXPECT_EQ(said_of(with([](auto& picture, float unwritten) { picture.depth[5] = unwritten; })),
            "plugin:x.so: draw_picture() wrote nothing to picture->depth (pixel 0, 1, sample 1)");
  EXPECT_EQ(said_of(with([](auto& picture, float unwritten) { picture.color[20] = unwritten; })),
            "plugin:x.so: draw_picture() wrote nothing to picture->color (pixel 1, 1, sample 0, "
            "channel 2)");
  EXPECT_EQ(said_of(with([](auto& picture, float) { picture.color[1] = 0.3F; })), "");
  EXPECT_EQ(said_of(with([](auto& picture, float) { picture.color[1] = 0.3F; }), bytes),
            "plugin:x.so: draw_picture() wrote 0.3 to picture->color, which is not the float k / "
            "255 of any byte k (pixel 0, 0, sample 0, channel 1)");
  for (const float none : {-1 / 255.0F, 256 / 255.0F, std::nanf("")}) {
    EXPECT_NE(said_of(with([=](auto& picture, float) { picture.color[1] = none; }), bytes), "");
  }
  for (const float byte : {0.0F, 1 / 255.0F, 85 / 255.0F, 254 / 255.0F}) {
    EXPECT_EQ(said_of(with([=](auto& picture, float) { picture.color[1] = byte; }), bytes), "");
  }
  // A NaN of a plugin's own is a number that it wrote; properties judge it.
  EXPECT_EQ(said_of(with([](auto& picture, float) {
              picture.color[1] = std::numeric_limits<float>::quiet_NaN();
              picture.depth[0] = std::numeric_limits<float>::quiet_NaN();
            })),
            "");
}

TEST(PictureDrawing, SaysWhyThereIsNoPicture) {
  const auto answers = [](std::uint32_t status, const char* message) {
    return [=](const rastercheck_draw&, const rastercheck_pipeline&,
               rastercheck_picture& picture) -> std::uint32_t {
      EXPECT_GT(picture.message_size, std::strlen(message));
      std::strcpy(picture.message, message);
      return status;
    };
  };
  EXPECT_EQ(said_of(answers(RASTERCHECK_UNSUPPORTED, "no textures")),
            "plugin:x.so: draw_picture() reported unsupported: no textures");
  EXPECT_EQ(said_of(answers(RASTERCHECK_FAILED, "")),
            "plugin:x.so: draw_picture() reported failed: (no message)");
  EXPECT_EQ(said_of([](const rastercheck_draw&, const rastercheck_pipeline&,
                       rastercheck_picture& picture) -> std::uint32_t {
              fill(picture, 0, 0);
              picture.depth[-1] = 1;
              return RASTERCHECK_OK;
            }),
            "plugin:x.so: draw_picture() wrote before the beginning of picture->depth");

  PictureDrawing drawing("x.so");
  Plugin plugin = plugin_with(answers(RASTERCHECK_UNSUPPORTED, "no textures"));
  EXPECT_EQ(drawing.draw(plugin, small_case(), {}).error().failure, Failure::unsupported);
  // A plugin without a depth test of its own draws pictures all the same.
  plugin.contract.lacks = RASTERCHECK_LACKS_DEPTH_TEST;
  EXPECT_EQ(to_string(drawing.draw(plugin, small_case(), {}).error()),
            "plugin:x.so: draw_picture() reported unsupported: no textures");
  plugin.contract.lacks = RASTERCHECK_LACKS_SMOOTH;
  const auto lacking = drawing.draw(plugin, small_case(), {});
  EXPECT_EQ(to_string(lacking.error()), "plugin:x.so: its contract lacks smooth attributes");
  EXPECT_EQ(lacking.error().failure, Failure::unsupported);
}

// Kills: a shader that reads attributes that the case does not have.
TEST(PictureDrawing, NeedsTheAttributesOfItsColours) {
  const Plugin plugin = plugin_with([](const auto&...) -> std::uint32_t {
    ADD_FAILURE() << "is not asked";
    return RASTERCHECK_OK;
  });
  cases::Case c = small_case();
  PictureDrawing drawing("x.so");
  const auto said = [&](std::size_t attributes, const cases::Pipeline& pipeline) {
    c.attributes.resize(attributes);
    c.attribute_values.resize(attributes * c.positions.size());
    return to_string(drawing.draw(plugin, c, pipeline).error());
  };
  cases::Pipeline pipeline;
  pipeline.shading = cases::Shading::vertex_colors;
  EXPECT_EQ(said(2, pipeline), "plugin:x.so: vertex colours need 3 attributes");
  pipeline.texturing.emplace().texture = {1, 1, {1, 2, 3, 4}};
  EXPECT_EQ(said(1, pipeline), "plugin:x.so: textures need 2 attributes");
}

TEST(PluginContract, PromisesPicturesToTheBitUnlessItSaysOtherwise) {
  EXPECT_EQ(contract_of(rastercheck_contract{}, small_case()).picture_bounds, std::nullopt);
  const auto bounds = [](auto change) {
    rastercheck_contract contract{};
    change(contract);
    return contract_of(contract, small_case()).picture_bounds;
  };
  cases::PictureBounds expected;
  EXPECT_EQ(bounds([](auto& c) { c.pictures = RASTERCHECK_PICTURES_ROUNDED_COORDINATES; }),
            expected);
  expected.keeps_fragments = false;
  EXPECT_EQ(bounds([](auto& c) { c.pictures = RASTERCHECK_PICTURES_OTHER_FRAGMENTS; }), expected);
  expected = {};
  expected.resolves_to_mean = false;
  EXPECT_EQ(bounds([](auto& c) { c.pictures = RASTERCHECK_PICTURES_NO_MEAN; }), expected);
  EXPECT_EQ(bounds([](auto& c) {
              c.float_error = 3;
              c.byte_store = 0.6F;
              c.byte_blend = 2;
              c.byte_mean = 1;
              c.texel_share = 0x1p-24F;
              c.texel_distance = 0x1p-8F;
            }),
            (cases::PictureBounds{true, true, 3, 0.6F, 2, 1, 0x1p-24F, 0x1p-8F}));
  expected = {};
  expected.byte_blend = 2;  // the others stay at one half
  EXPECT_EQ(bounds([](auto& c) { c.byte_blend = 2; }), expected);
}

TEST(PluginContract, PromisesDifferencesAndFilteringOnlyIfItSaysSo) {
  rastercheck_contract contract{};
  contract.filter_share = 1;
  EXPECT_EQ(contract_of(contract, small_case()).quad_share, std::nullopt);
  EXPECT_EQ(contract_of(contract, small_case()).texture_bounds, std::nullopt);
  contract.quad_share = 0x1p-20F;
  contract.filter_constant = 2;
  contract.bilinear = 6;
  contract.trilinear = 8;
  contract.derivative_share = 3;
  const cases::Contract promised = contract_of(contract, small_case());
  EXPECT_EQ(promised.quad_share, 0x1p-20F);
  EXPECT_EQ(promised.texture_bounds, (cases::TextureBounds{1, 2, 6, 8, 3}));
  EXPECT_EQ(promised.picture_bounds, std::nullopt);
}

TEST(Plugin, DrawsPicturesIfItSaysHow) {
  rastercheck_contract contract{};
  contract.size = sizeof contract;
  rastercheck_plugin plugin{};
  plugin.size = sizeof plugin;
  plugin.abi = RASTERCHECK_PLUGIN_ABI;
  plugin.name = "mine";
  plugin.version = "1";
  plugin.contract = &contract;
  plugin.draw = [](const rastercheck_draw*, rastercheck_output*) -> std::uint32_t {
    return RASTERCHECK_OK;
  };
  EXPECT_EQ(checked_plugin(&plugin, "x.so").value().draw_picture, nullptr);
  plugin.draw_picture = &call_body;
  EXPECT_EQ(checked_plugin(&plugin, "x.so").value().draw_picture, &call_body);
  // Kills: a pointer read beyond the struct of a plugin from before there were pictures.
  plugin.size = offsetof(rastercheck_plugin, draw_picture);
  EXPECT_EQ(checked_plugin(&plugin, "x.so").value().draw_picture, nullptr);
  plugin.size = sizeof plugin;
  contract.lacks = RASTERCHECK_LACKS_DEPTH;
  EXPECT_EQ(to_string(checked_plugin(&plugin, "x.so").error()),
            "plugin:x.so: its draw_picture contradicts its contract, which lacks DEPTH: pictures "
            "have depths");
  contract.lacks = 0;
  contract.byte_mean = 256;
  EXPECT_EQ(to_string(checked_plugin(&plugin, "x.so").error()),
            "plugin:x.so: its contract's byte_mean is 256, but must be from 0 to 255");
}

}  // namespace
}  // namespace rastercheck::backends::picture_drawing_test
