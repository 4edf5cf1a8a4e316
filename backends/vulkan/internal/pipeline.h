#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"

namespace rastercheck::backends::vulkan {

/// What a pipeline that draws lists of triangles is made of. Viewport, scissor, culling, front face
/// and the function of the depth test, which writes, are set when a draw is recorded.
struct PipelineSource {
  std::span<const std::uint32_t> vertex_shader;
  std::span<const std::uint32_t> fragment_shader;
  const VkSpecializationInfo* fragment_constants = nullptr;
  std::uint32_t vertex_size = 0;  ///< bytes
  std::vector<VkVertexInputAttributeDescription> inputs;
  int samples = 1;
  bool depth_clamp = false;
  bool negative_one_to_one = false;  ///< clip depth −w…w
  bool provoking_last = false;
  std::vector<VkFormat> colors;
  bool has_depth = true;  ///< else there is neither a depth test nor an image for it
};

Result<Pipeline> make_pipeline(const Device& device, VkPipelineLayout layout,
                               const PipelineSource& source);

/// Of pipelines without descriptors or push constants.
Result<PipelineLayout> make_empty_layout(const Device& device);

Result<ShaderModule> make_module(const Device& device, std::span<const std::uint32_t> words);

/// A shader's stage, `main` of the module.
VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits which, const ShaderModule& module,
                                         const VkSpecializationInfo* constants = nullptr);

}  // namespace rastercheck::backends::vulkan
