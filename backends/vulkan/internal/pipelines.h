#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"
#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {

/// What a pipeline is made for; everything else of a draw is set when it is recorded.
struct PipelineKind {
  int samples = 1;
  bool depth_clamp = false;
  bool negative_one_to_one = false;  ///< clip depth −w…w
  bool provoking_last = false;
  std::size_t clip_distances = 0;  ///< of the shader (shaders.h)
  /// Whether fragments append records to the buffer of appending_layout() and write nothing else.
  bool appends = false;
  std::vector<Qualifier> slots;
  auto operator<=>(const PipelineKind&) const = default;
};

/// Floats of a vertex in the buffer that these pipelines read: position, number of the triangle,
/// clip distances, slots.
struct VertexLayout {
  std::size_t clip_distances = 5;  ///< where they begin
  std::size_t slots = 5;           ///< where they begin
  std::size_t size = 5;
};
VertexLayout vertex_layout(const PipelineKind& kind);

/// Pipelines, kept for the next case of their kind.
class Pipelines {
 public:
  static Result<Pipelines> create(const Device& device);

  /// The pipeline lives until another one is asked for. Viewport, scissor, culling, front face and
  /// depth test are dynamic.
  Result<VkPipeline> get(const Device& device, const PipelineKind& kind);

  /// The layout of pipelines that append: a storage buffer at set 0, binding 0, and a push
  /// constant, how many records the buffer has room for.
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
