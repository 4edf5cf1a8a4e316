#include "backends/plugin/picture_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "backends/plugin/draw_state.h"

namespace rastercheck::backends {
namespace {

constexpr float kMostByte = 255;

/// A NaN that no arithmetic makes of numbers: what still has these bits was not written.
constexpr std::uint32_t kUnwritten = 0x7fd5a5a5;

std::size_t samples_of(const cases::FramebufferSize& size) {
  return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
         static_cast<std::size_t>(size.samples);
}

/// The picture that a pipeline makes of a case, without numbers.
cases::Picture shape_of(const cases::Case& c, const cases::Pipeline& pipeline) {
  cases::Picture shape;
  shape.size = c.framebuffer;
  if (pipeline.resolves) shape.size.samples = 1;
  constexpr std::size_t kColor = 4;
  const bool has_four = pipeline.texturing || cases::has_four_channels(pipeline.shading);
  shape.channels = has_four ? kColor : c.attributes.size();
  return shape;
}

/// Says that a case has too few attributes for a pipeline's colours; empty if it has enough.
std::string missing_attributes(const cases::Case& c, const cases::Pipeline& pipeline) {
  if (pipeline.texturing) return c.attributes.size() < 2 ? "textures need 2 attributes" : "";
  const bool has_colors = pipeline.shading == cases::Shading::vertex_colors;
  return has_colors && c.attributes.size() < 3 ? "vertex colours need 3 attributes" : "";
}

std::uint32_t compare_of(cases::DepthFunction function) {
  switch (function) {
    case cases::DepthFunction::always:
      return RASTERCHECK_COMPARE_ALWAYS;
    case cases::DepthFunction::never:
      return RASTERCHECK_COMPARE_NEVER;
    case cases::DepthFunction::less:
      return RASTERCHECK_COMPARE_LESS;
    case cases::DepthFunction::equal:
      return RASTERCHECK_COMPARE_EQUAL;
    case cases::DepthFunction::less_or_equal:
      return RASTERCHECK_COMPARE_LESS_OR_EQUAL;
    case cases::DepthFunction::greater:
      return RASTERCHECK_COMPARE_GREATER;
    case cases::DepthFunction::not_equal:
      return RASTERCHECK_COMPARE_NOT_EQUAL;
    case cases::DepthFunction::greater_or_equal:
      break;
  }
  return RASTERCHECK_COMPARE_GREATER_OR_EQUAL;
}

std::uint32_t blend_of(cases::Blend blend) {
  if (blend == cases::Blend::off) return RASTERCHECK_BLEND_OFF;
  return blend == cases::Blend::over ? RASTERCHECK_BLEND_OVER : RASTERCHECK_BLEND_ADDITIVE;
}

std::uint32_t shading_of(cases::Shading shading) {
  switch (shading) {
    case cases::Shading::attributes:
      return RASTERCHECK_SHADING_ATTRIBUTES;
    case cases::Shading::vertex_colors:
      return RASTERCHECK_SHADING_VERTEX_COLORS;
    case cases::Shading::differences_along_x:
      return RASTERCHECK_SHADING_DIFFERENCES_X;
    case cases::Shading::differences_along_y:
      return RASTERCHECK_SHADING_DIFFERENCES_Y;
    case cases::Shading::facing:
      return RASTERCHECK_SHADING_FACING;
    case cases::Shading::window_coordinates:
      break;
  }
  return RASTERCHECK_SHADING_WINDOW_COORDINATES;
}

std::uint32_t wrap_of(cases::Wrap wrap) {
  if (wrap == cases::Wrap::repeat) return RASTERCHECK_WRAP_REPEAT;
  return wrap == cases::Wrap::clamp ? RASTERCHECK_WRAP_CLAMP : RASTERCHECK_WRAP_MIRROR;
}

std::uint32_t filter_of(cases::Filter filter) {
  if (filter == cases::Filter::nearest) return RASTERCHECK_FILTER_NEAREST;
  return filter == cases::Filter::bilinear ? RASTERCHECK_FILTER_BILINEAR
                                           : RASTERCHECK_FILTER_TRILINEAR;
}

/// The texture without its texels.
rastercheck_texture texture_of(const cases::Texturing& texturing) {
  rastercheck_texture texture{};
  texture.size = sizeof texture;
  texture.width = static_cast<std::uint32_t>(texturing.texture.width);
  texture.height = static_cast<std::uint32_t>(texturing.texture.height);
  texture.wrap_s = wrap_of(texturing.wrap_s);
  texture.wrap_t = wrap_of(texturing.wrap_t);
  texture.filter = filter_of(texturing.filter);
  return texture;
}

/// The pipeline without its texture.
rastercheck_pipeline plugin_pipeline(const cases::Pipeline& asked_for) {
  rastercheck_pipeline pipeline{};
  pipeline.size = sizeof pipeline;
  pipeline.depth_function = compare_of(asked_for.depth_function);
  pipeline.writes_depth = asked_for.writes_depth ? 1 : 0;
  pipeline.clear_depth = asked_for.clear_depth;
  pipeline.blend = blend_of(asked_for.blend);
  pipeline.format = asked_for.format == cases::ColorFormat::rgba8 ? RASTERCHECK_COLOR_RGBA8
                                                                  : RASTERCHECK_COLOR_FLOAT32;
  pipeline.shading = shading_of(asked_for.shading);
  pipeline.resolves = asked_for.resolves ? 1 : 0;
  pipeline.discard_below =
      asked_for.discard_below.value_or(-std::numeric_limits<float>::infinity());
  return pipeline;
}

bool is_written(float number) { return std::bit_cast<std::uint32_t>(number) != kUnwritten; }

/// True if a colour is the float of a byte k that means k/255.
bool is_byte(float color) {
  const float byte = std::round(color * kMostByte);
  return byte >= 0 && byte <= kMostByte && byte / kMostByte == color;
}

/// Where a sample of a picture is.
std::string words_for_place(const cases::Picture& shape, std::size_t at) {
  const auto samples = static_cast<std::size_t>(shape.size.samples);
  const auto width = static_cast<std::size_t>(shape.size.width);
  const std::size_t pixel = at / samples;
  return fmt::format("pixel {}, {}, sample {}", pixel % width, pixel / width, at % samples);
}

/// Describes a number that a plugin may not leave in a picture; empty if it may.
std::string fault_of_depth(float depth) {
  return is_written(depth) ? "" : "wrote nothing to picture->depth";
}
std::string fault_of_color(float color, cases::ColorFormat format) {
  if (!is_written(color)) return "wrote nothing to picture->color";
  if (format != cases::ColorFormat::rgba8 || is_byte(color)) return "";
  return fmt::format("wrote {} to picture->color, which is not the float k / 255 of any byte k",
                     color);
}

}  // namespace

Result<void> PictureDrawing::hand_over(const cases::Case& c, const cases::Pipeline& pipeline,
                                       const cases::Picture& shape) {
  const std::vector<float> places = sample_places(c);
  const std::vector<rastercheck_attribute> attributes = plugin_attributes(c);
  std::span<const std::byte> texels;
  if (pipeline.texturing) texels = std::as_bytes(std::span(pipeline.texturing->texture.texels));
  const std::array<std::pair<GuardedArray*, std::span<const std::byte>>, 7> inputs{
      {{&sample_positions_, std::as_bytes(std::span(places))},
       {&positions_, std::as_bytes(std::span(c.positions))},
       {&attributes_, std::as_bytes(std::span(attributes))},
       {&attribute_values_, std::as_bytes(std::span(c.attribute_values))},
       {&clip_distances_, std::as_bytes(std::span(c.clip_distances))},
       {&indices_, std::as_bytes(std::span(c.triangles))},
       {&texels_, texels}}};
  for (const auto& [array, bytes] : inputs) {
    if (Result<void> assigned = array->assign(bytes); !assigned) return assigned;
  }
  const std::size_t samples = samples_of(shape.size);
  const std::array<std::pair<GuardedArray*, std::size_t>, 3> outputs{
      {{&color_, samples * shape.channels * sizeof(float)},
       {&depth_, samples * sizeof(float)},
       {&message_, kMessageSize}}};
  for (const auto& [array, size] : outputs) {
    if (Result<void> resized = array->resize(size); !resized) return resized;
  }
  std::fill_n(color_.as<std::uint32_t>(), samples * shape.channels, kUnwritten);
  std::fill_n(depth_.as<std::uint32_t>(), samples, kUnwritten);
  std::fill_n(message_.as<char>(), kMessageSize, '\0');
  return {};
}

Result<void> PictureDrawing::check_fronts(const ForeignCall& foreign) const {
  for (const auto& [array, name] : {std::pair(&color_, "color"), std::pair(&depth_, "depth"),
                                    std::pair(&message_, "message")}) {
    if (array->size() == 0 || array->is_front_whole()) continue;
    return foreign.fail(
        fmt::format("draw_picture() wrote before the beginning of picture->{}", name));
  }
  return {};
}

/// The picture that the plugin wrote, if it wrote all of it.
Result<cases::Picture> PictureDrawing::taken(const ForeignCall& foreign, cases::ColorFormat format,
                                             cases::Picture shape) const {
  const std::size_t samples = samples_of(shape.size);
  const std::span<const float> depth(depth_.as<const float>(), samples);
  const std::span<const float> color(color_.as<const float>(), samples * shape.channels);
  for (std::size_t at = 0; at < samples; ++at) {
    if (const std::string fault = fault_of_depth(depth[at]); !fault.empty()) {
      return foreign.fail(fmt::format("draw_picture() {} ({})", fault, words_for_place(shape, at)));
    }
    for (std::size_t channel = 0; channel < shape.channels; ++channel) {
      const float number = color[at * shape.channels + channel];
      if (const std::string fault = fault_of_color(number, format); !fault.empty()) {
        return foreign.fail(fmt::format("draw_picture() {} ({}, channel {})", fault,
                                        words_for_place(shape, at), channel));
      }
    }
  }
  shape.depth.assign(depth.begin(), depth.end());
  shape.color.assign(color.begin(), color.end());
  return shape;
}

Result<cases::Picture> PictureDrawing::draw(const Plugin& plugin, const cases::Case& c,
                                            const cases::Pipeline& pipeline) {
  const ForeignCall foreign{path_, "draw_picture", &message_};
  cases::Case untested = c;
  // The pipeline has a depth function, whether or not draw() has a depth test.
  untested.depth_test = cases::DepthTest::none;
  if (const std::string what = lacks(plugin.contract, untested); !what.empty()) {
    return foreign.fail("its contract lacks " + what, Failure::unsupported);
  }
  if (const std::string what = missing_attributes(c, pipeline); !what.empty()) {
    return foreign.fail(what, Failure::unsupported);
  }
  const cases::Picture shape = shape_of(c, pipeline);
  if (!hand_over(untested, pipeline, shape)) {
    return foreign.fail(
        fmt::format("the arrays of a picture of {} x {} pixels of {} samples do not fit into the "
                    "memory of its process",
                    c.framebuffer.width, c.framebuffer.height, c.framebuffer.samples),
        Failure::unsupported);
  }
  rastercheck_draw draw = draw_state(untested, contract_of(plugin.contract, untested));
  draw.sample_positions = sample_positions_.as<const float>();
  draw.positions = positions_.as<const float>();
  draw.attributes = attributes_.as<const rastercheck_attribute>();
  draw.attribute_values = attribute_values_.as<const float>();
  draw.clip_distances = clip_distances_.as<const float>();
  draw.triangle_count = static_cast<std::uint32_t>(c.triangles.size());
  draw.indices = indices_.as<const std::uint32_t>();
  rastercheck_pipeline asked_for = plugin_pipeline(pipeline);
  rastercheck_texture texture{};
  if (pipeline.texturing) {
    texture = texture_of(*pipeline.texturing);
    texture.texels = texels_.as<const std::uint8_t>();
    asked_for.texture = &texture;
  }
  rastercheck_picture picture{};
  picture.size = sizeof picture;
  picture.width = static_cast<std::uint32_t>(shape.size.width);
  picture.height = static_cast<std::uint32_t>(shape.size.height);
  picture.samples = static_cast<std::uint32_t>(shape.size.samples);
  picture.channels = static_cast<std::uint32_t>(shape.channels);
  picture.message_size = kMessageSize;
  picture.color = color_.as<float>();
  picture.depth = depth_.as<float>();
  picture.message = message_.as<char>();
  const Result<void> called =
      foreign([&] { return plugin.draw_picture(&draw, &asked_for, &picture); },
              [&] { return check_fronts(foreign); });
  if (!called) return tl::unexpected(called.error());
  return taken(foreign, pipeline.format, shape);
}

}  // namespace rastercheck::backends
