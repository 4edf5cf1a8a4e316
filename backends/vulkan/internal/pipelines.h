#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"
#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {

/// The properties that a pipeline depends on; all other state is set when a draw is recorded.
struct PipelineKind {
  int samples = 1;
  bool depth_clamp = false;
  bool negative_one_to_one = false;  ///< clip depth from −w to w
  bool provoking_last = false;
  std::size_t clip_distances = 0;  ///< as declared by the shader (shaders.h)
  cases::DepthFormat depth = cases::DepthFormat::float32;
  /// True if fragments only append records to the buffer of appending_layout().
  bool appends = false;
  std::vector<Qualifier> slots;
  auto operator<=>(const PipelineKind&) const = default;
};

/// The floats of a vertex in the buffer that these pipelines read: position, triangle number, clip
/// distances, slots.
struct VertexLayout {
  std::size_t clip_distances = 5;  ///< index of the first clip distance
  std::size_t slots = 5;           ///< index of the first slot's floats
  std::size_t size = 5;
};
VertexLayout vertex_layout(const PipelineKind& kind);

/// Makes pipelines and keeps them for later cases of the same kind.
class Pipelines {
 public:
  static Result<Pipelines> create(const Device& device);

  /// Returns a pipeline, which lives until get() is called again. Viewport, scissor, culling, front
  /// face, depth bias and depth test are dynamic.
  Result<VkPipeline> get(const Device& device, const PipelineKind& kind);

  /// The layout of pipelines that append: a storage buffer at set 0, binding 0, and a push constant
  /// that is the number of records that fit into the buffer.
  VkPipelineLayout appending_layout() const { return appending_layout_.get(); }
  VkDescriptorSetLayout records_layout() const { return records_layout_.get(); }

 private:
  Pipelines() = default;

  PipelineLayout layout_;
  DescriptorSetLayout records_layout_;
  PipelineLayout appending_layout_;
  std::map<PipelineKind, Pipeline> made_;
};

}  // namespace rastercheck::backends::vulkan
