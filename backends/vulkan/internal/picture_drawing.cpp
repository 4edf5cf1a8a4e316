#include "backends/vulkan/internal/picture_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "backends/primitive_vertices.h"
#include "backends/vulkan/internal/case_commands.h"
#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {
namespace {

constexpr std::size_t kColorChannels = 4;
/// The most floats of all vertices, which the process holds twice.
constexpr std::size_t kMaxVertexFloats = std::size_t{1} << 28U;

bool has_four_channels(const cases::Case& c, const cases::Pipeline& pipeline) {
  return pipeline.texturing || cases::has_four_channels(pipeline.shading) ||
         c.attributes.size() == kColorChannels;
}

std::size_t channels_of(const cases::Case& c, const cases::Pipeline& pipeline) {
  return has_four_channels(c, pipeline) ? kColorChannels : c.attributes.size();
}

/// The reason why the pipeline has no meaning for the case; empty if it has one.
std::string problem_with(const cases::Case& c, const cases::Pipeline& pipeline) {
  const std::size_t attributes = c.attributes.size();
  if (pipeline.texturing) {
    const cases::Texture& texture = pipeline.texturing->texture;
    if (attributes < 2) {
      return fmt::format("a texture needs two attributes as coordinates, the case has {}",
                         attributes);
    }
    if (texture.width < 1 || texture.height < 1 ||
        texture.texels.size() != kColorChannels * static_cast<std::size_t>(texture.width) *
                                     static_cast<std::size_t>(texture.height)) {
      return fmt::format("a texture of {} x {} texels needs four bytes for each, it has {}",
                         texture.width, texture.height, texture.texels.size());
    }
  } else if (pipeline.shading == cases::Shading::vertex_colors && attributes < 3) {
    return fmt::format("vertex colours need at least three attributes, the case has {}",
                       attributes);
  } else if (pipeline.discard_below && attributes == 0) {
    return "discarding needs a texture or an attribute, the case has neither";
  }
  if (has_four_channels(c, pipeline)) return "";
  if (pipeline.format == cases::ColorFormat::rgba8) {
    return fmt::format("rgba8 needs four channels, the picture has {}", attributes);
  }
  if (pipeline.blend != cases::Blend::over) return "";
  return fmt::format("blending `over` needs four channels, the picture has {}", attributes);
}

VkCompareOp compare_op(cases::DepthFunction function) {
  switch (function) {
    case cases::DepthFunction::always:
      return VK_COMPARE_OP_ALWAYS;
    case cases::DepthFunction::never:
      return VK_COMPARE_OP_NEVER;
    case cases::DepthFunction::less:
      return VK_COMPARE_OP_LESS;
    case cases::DepthFunction::equal:
      return VK_COMPARE_OP_EQUAL;
    case cases::DepthFunction::less_or_equal:
      return VK_COMPARE_OP_LESS_OR_EQUAL;
    case cases::DepthFunction::greater:
      return VK_COMPARE_OP_GREATER;
    case cases::DepthFunction::not_equal:
      return VK_COMPARE_OP_NOT_EQUAL;
    case cases::DepthFunction::greater_or_equal:
      break;
  }
  return VK_COMPARE_OP_GREATER_OR_EQUAL;
}

/// The place of an attribute among slots: 4 · slot + component.
std::int32_t source_of(std::size_t attribute, const std::vector<Slot>& slots) {
  for (std::size_t s = 0; s < slots.size(); ++s) {
    const auto& all = slots[s].attributes;
    const auto found = std::find(all.begin(), all.end(), attribute);
    if (found != all.end()) {
      return static_cast<std::int32_t>(kSlotSize * s) +
             static_cast<std::int32_t>(found - all.begin());
    }
  }
  return -1;
}

std::int32_t shows_of(const cases::Pipeline& pipeline) {
  if (pipeline.texturing) return pipeline.texturing->filter == cases::Filter::trilinear ? 3 : 0;
  switch (pipeline.shading) {
    case cases::Shading::attributes:
    case cases::Shading::vertex_colors:
      break;
    case cases::Shading::differences_along_x:
      return 1;
    case cases::Shading::differences_along_y:
      return 2;
    case cases::Shading::facing:
      return 4;
    case cases::Shading::window_coordinates:
      return 5;
  }
  return 0;
}

/// The attributes that a draw of `channels` channels from index `first` on shows.
std::vector<std::size_t> shown_attributes(const cases::Case& c, const cases::Pipeline& pipeline,
                                          std::size_t first, std::size_t channels) {
  std::size_t count = std::min(channels, c.attributes.size() - first);
  if (pipeline.texturing) {
    count = 2;
  } else if (pipeline.shading == cases::Shading::facing ||
             pipeline.shading == cases::Shading::window_coordinates) {
    count = 0;
  }
  std::vector<std::size_t> shown(count);
  std::iota(shown.begin(), shown.end(), first);
  return shown;
}

}  // namespace

/// Up to four channels, which one draw makes from up to four attributes.
struct PictureDrawing::Group {
  std::size_t channels = 0;
  std::vector<Slot> slots;
  PictureConstants constants;

  Group(const cases::Case& c, const cases::Pipeline& pipeline, std::size_t first, std::size_t count)
      : channels(count) {
    const std::vector<std::size_t> shown = shown_attributes(c, pipeline, first, count);
    std::vector<std::size_t> used = shown;
    const bool discards_by_value = pipeline.discard_below && !pipeline.texturing;
    const std::size_t last = c.attributes.size() - 1;
    const bool needs_last = discards_by_value && (used.empty() || used.back() != last);
    if (needs_last) used.push_back(last);
    slots = widened(slots_of(c, used), c.framebuffer.samples);
    for (std::size_t k = 0; k < kColorChannels; ++k) {
      constants.sources[k] = k < shown.size() ? source_of(shown[k], slots) : -1;
    }
    constants.shows = shows_of(pipeline);
    if (pipeline.discard_below) constants.discard_below = *pipeline.discard_below;
    if (discards_by_value) constants.discarding_source = source_of(last, slots);
  }
};

Result<void> PictureDrawing::make_texture(const cases::Texturing& texturing) {
  if (texture_ && texture_->is_for(texturing)) return {};
  texture_.reset();
  Result<TextureImage> image =
      TextureImage::create(*shared_->device, shared_->pipelines.texture_layout(), texturing);
  if (!image) return tl::unexpected(image.error());
  texture_ = *std::move(image);
  return {};
}

Result<void> PictureDrawing::draw_group(const cases::Case& c, const cases::Pipeline& pipeline,
                                        const Group& group, const Target& target) {
  const Device& device = *shared_->device;
  PipelineKind kind = kind_of(c, device.limits(), group.slots);
  kind.writes_depth = pipeline.writes_depth;
  kind.output = pipeline.texturing ? Output::texture_colors : Output::colors;
  kind.color = target.shape().slot_format;
  kind.blend = pipeline.blend;
  const Result<VkPipeline> made = shared_->pipelines.get(device, kind);
  if (!made) return tl::unexpected(made.error());
  if (pipeline.texturing) {
    if (Result<void> image = make_texture(*pipeline.texturing); !image) return image;
  }
  const VertexLayout layout = vertex_layout(kind);
  const std::size_t vertices = vertices_per(c.primitive) * c.triangles.size();
  if (vertices > kMaxVertexFloats / layout.size) {
    return failed(
        fmt::format("{} triangles do not fit into the memory of its process", c.triangles.size()),
        Failure::unsupported);
  }
  std::vector<float> floats;
  floats.reserve(vertices * layout.size);
  for (std::size_t t = 0; t < c.triangles.size(); ++t) {
    append_primitive(c, group.slots, layout, t, 0, floats);
  }
  if (Result<void> handed = shared_->hand_over(floats); !handed) return handed;

  return shared_->commands.run(device, [&](VkCommandBuffer buffer) {
    const VkPipelineLayout used = shared_->pipelines.picture_layout();
    if (pipeline.texturing) texture_->fill(buffer);
    target.begin(buffer);
    target.begin_layer(buffer, 0, pipeline.clear_depth);
    if (!c.triangles.empty()) {
      bind_case(buffer, c, *made, shared_->vertices.buffer.get());
      vkCmdSetDepthCompareOp(buffer, compare_op(pipeline.depth_function));
      if (pipeline.texturing) texture_->bind(buffer, used);
      vkCmdPushConstants(buffer, used, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof group.constants,
                         &group.constants);
      vkCmdDraw(buffer, static_cast<std::uint32_t>(vertices), 1, 0, 0);
    }
    Target::end_layer(buffer);
    target.end(buffer, shared_->reader, 1);
  });
}

/// The depths as stored. A resolved picture has those of each pixel's sample 0.
Result<std::vector<float>> PictureDrawing::depths_of(const Target& target,
                                                     const DepthReading& reading,
                                                     bool resolves) const {
  const std::vector<float> read = target.depths(0);
  const std::size_t step = resolves ? static_cast<std::size_t>(target.shape().samples) : 1;
  std::vector<float> depths;
  depths.reserve(read.size() / step);
  for (std::size_t i = 0; i < read.size(); i += step) {
    if (reading.is_open(read[i])) {
      return failed(fmt::format("its shaders fetch different depths of {} bits as the same number",
                                reading.bits),
                    Failure::unsupported);
    }
    const Result<float> depth = reading.stored(read[i], false);
    if (!depth) return tl::unexpected(depth.error());
    depths.push_back(*depth);
  }
  return depths;
}

Result<cases::Picture> PictureDrawing::draw(const cases::Case& c, const cases::Pipeline& pipeline,
                                            const std::function<void()>& go_on) {
  if (const std::string problem = problem_with(c, pipeline); !problem.empty()) {
    return failed(problem);
  }
  const Result<DepthReading> reading = shared_->depth_reading(c);
  if (!reading) return tl::unexpected(reading.error());
  TargetShape shape{c.framebuffer.width, c.framebuffer.height, c.framebuffer.samples, 1, 1,
                    c.depth_format};
  shape.has_numbers = false;
  shape.slot_format = pipeline.format == cases::ColorFormat::rgba8 ? kByteFormat : kSlotFormat;
  shape.resolves = pipeline.resolves;
  const Result<const Target*> target = shared_->target_for(shape);
  if (!target) return tl::unexpected(target.error());

  cases::Picture picture;
  picture.size = c.framebuffer;
  if (pipeline.resolves) picture.size.samples = 1;
  picture.channels = channels_of(c, pipeline);
  // A picture without channels still has depths.
  for (std::size_t first = 0; first == 0 || first < picture.channels; first += kColorChannels) {
    const Group group(c, pipeline, first, std::min(kColorChannels, picture.channels - first));
    if (const Result<void> drawn = draw_group(c, pipeline, group, **target); !drawn) {
      return tl::unexpected(drawn.error());
    }
    Result<std::vector<float>> depths = depths_of(**target, *reading, pipeline.resolves);
    if (!depths) return tl::unexpected(depths.error());
    if (first == 0) {
      picture.color.resize(depths->size() * picture.channels);
      picture.depth = *std::move(depths);
    } else if (*depths != picture.depth) {
      return failed("the case left other depths when it was drawn again with its other attributes");
    }
    const std::vector<float> colors = (*target)->colors(0, 0);
    for (std::size_t i = 0; i < picture.depth.size(); ++i) {
      for (std::size_t k = 0; k < group.channels; ++k) {
        picture.color[i * picture.channels + first + k] = colors[i * kSlotSize + k];
      }
    }
    go_on();
  }
  return picture;
}

}  // namespace rastercheck::backends::vulkan
