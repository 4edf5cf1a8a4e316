#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"
#include "backends/vulkan/slots.h"
#include "cases/case.h"
#include "cases/picture.h"
#include "cases/picture_layout.h"

namespace rastercheck::backends::vulkan {

/// What fragments leave.
enum class Output {
  numbers_and_slots,  ///< a triangle's number and its slots, each in an image
  records,            ///< records in the buffer of appending_layout(), and nothing else
  colors,             ///< four channels of a picture, made of attributes (picture_layout())
  texture_colors      ///< likewise, looked up in a texture
};

/// The properties that a pipeline depends on; all other state is set when a draw is recorded.
struct PipelineKind {
  cases::Primitive primitive = cases::Primitive::triangles;
  cases::Topology topology = cases::Topology::triangles;
  VkLineRasterizationModeEXT line_mode = VK_LINE_RASTERIZATION_MODE_DEFAULT_EXT;
  int samples = 1;
  bool depth_clamp = false;
  bool negative_one_to_one = false;  ///< clip depth from −w to w
  bool provoking_last = false;
  std::size_t clip_distances = 0;  ///< as declared by the shader (shaders.h)
  cases::DepthFormat depth = cases::DepthFormat::float32;
  bool writes_depth = true;
  Output output = Output::numbers_and_slots;
  VkFormat color = kSlotFormat;  ///< of a picture
  cases::Blend blend = cases::Blend::off;
  std::vector<Qualifier> slots;
  auto operator<=>(const PipelineKind&) const = default;
};

/// The floats of a vertex in the buffer that these pipelines read: position, triangle number, clip
/// distances, slots, and the size of a point.
struct VertexLayout {
  std::size_t clip_distances = 5;  ///< index of the first clip distance
  std::size_t slots = 5;           ///< index of the first slot's floats
  std::size_t point_size = 5;      ///< index of the size, which only points have
  std::size_t size = 5;
};
VertexLayout vertex_layout(const PipelineKind& kind);

/// The push constants of pipelines for pictures, as in shaders/picture.frag.
struct PictureConstants {
  /// 4 · slot + component of each channel's values. −1: the channel is 1.
  std::array<std::int32_t, 4> sources{};
  /// 0: values; 1, 2: differences along x, y; 3: a texture's levels; 4: facing; 5: window
  /// coordinates.
  std::int32_t shows = 0;
  float discard_below = -std::numeric_limits<float>::infinity();
  /// Without a texture, the source of the value that discarding depends on. −1: nothing is
  /// discarded.
  std::int32_t discarding_source = -1;
};

/// Makes pipelines and keeps them for later cases of the same kind.
class Pipelines {
 public:
  static Result<Pipelines> create(const Device& device);

  /// Returns a pipeline, which lives until get() is called again. Viewport, scissor, culling, front
  /// face, depth bias, depth test and the width of lines are dynamic.
  Result<VkPipeline> get(const Device& device, const PipelineKind& kind);

  /// The layout of pipelines that append: a storage buffer at set 0, binding 0, and a push constant
  /// that is the number of records that fit into the buffer.
  VkPipelineLayout appending_layout() const { return appending_layout_.get(); }
  VkDescriptorSetLayout records_layout() const { return records_layout_.get(); }

  /// The layout of pipelines for pictures: a texture with its sampler at set 0, binding 0, which
  /// only Output::texture_colors needs, and PictureConstants.
  VkPipelineLayout picture_layout() const { return picture_layout_.get(); }
  VkDescriptorSetLayout texture_layout() const { return texture_layout_.get(); }

 private:
  Pipelines() = default;
  VkPipelineLayout layout_of(Output output) const;

  PipelineLayout layout_;
  DescriptorSetLayout records_layout_;
  PipelineLayout appending_layout_;
  DescriptorSetLayout texture_layout_;
  PipelineLayout picture_layout_;
  std::map<PipelineKind, Pipeline> made_;
};

}  // namespace rastercheck::backends::vulkan
