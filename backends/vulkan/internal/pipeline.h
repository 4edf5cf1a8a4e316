#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"
#include "cases/case.h"
#include "cases/picture.h"
#include "cases/picture_layout.h"

namespace rastercheck::backends::vulkan {

/// The parts of a pipeline that draws lists, strips or fans. Not among them are the
/// viewport, the scissor, culling, the front face, the depth bias, the function of the depth test
/// and the width of lines, which are set when a draw is recorded.
struct PipelineSource {
  std::span<const std::uint32_t> vertex_shader;
  std::span<const std::uint32_t> fragment_shader;
  const VkSpecializationInfo* fragment_constants = nullptr;
  std::uint32_t vertex_size = 0;  ///< bytes
  std::vector<VkVertexInputAttributeDescription> inputs;
  cases::Primitive primitive = cases::Primitive::triangles;
  cases::Topology topology = cases::Topology::triangles;  ///< strips and fans have restarts
  VkLineRasterizationModeEXT line_mode = VK_LINE_RASTERIZATION_MODE_DEFAULT_EXT;
  int samples = 1;
  bool depth_clamp = false;
  bool negative_one_to_one = false;  ///< clip depth from −w to w
  bool provoking_last = false;
  std::vector<VkFormat> colors;
  cases::Blend blend = cases::Blend::off;  ///< of all colours
  VkFormat depth = kFloatDepth;            ///< if undefined: no depth test and no depth image
  bool writes_depth = true;                ///< true if fragments that pass the test replace depths
};

Result<Pipeline> make_pipeline(const Device& device, VkPipelineLayout layout,
                               const PipelineSource& source);

/// A layout for pipelines without descriptors and push constants.
Result<PipelineLayout> make_empty_layout(const Device& device);

Result<ShaderModule> make_module(const Device& device, std::span<const std::uint32_t> words);

/// The shader stage whose entry point is `main` of the module.
VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits which, const ShaderModule& module,
                                         const VkSpecializationInfo* constants = nullptr);

}  // namespace rastercheck::backends::vulkan
