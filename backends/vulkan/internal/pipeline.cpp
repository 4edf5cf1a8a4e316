#include "backends/vulkan/internal/pipeline.h"

#include <array>
#include <utility>

namespace rastercheck::backends::vulkan {
namespace {

/// How a colour attachment takes all channels of a fragment's colour.
VkPipelineColorBlendAttachmentState attachment_state(cases::Blend blend) {
  VkPipelineColorBlendAttachmentState state{};
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                         VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  if (blend == cases::Blend::off) return state;
  const bool is_over = blend == cases::Blend::over;
  state.blendEnable = VK_TRUE;
  state.srcColorBlendFactor = is_over ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstColorBlendFactor = is_over ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
  state.dstAlphaBlendFactor = state.dstColorBlendFactor;
  state.colorBlendOp = VK_BLEND_OP_ADD;
  state.alphaBlendOp = VK_BLEND_OP_ADD;
  return state;
}

VkPrimitiveTopology topology_of(cases::Primitive primitive, cases::Topology topology) {
  const bool is_of_lines = primitive == cases::Primitive::lines;
  if (topology == cases::Topology::strip) {
    return is_of_lines ? VK_PRIMITIVE_TOPOLOGY_LINE_STRIP : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
  }
  if (topology == cases::Topology::fan) return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN;
  switch (primitive) {
    case cases::Primitive::triangles:
      return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    case cases::Primitive::lines:
      return VK_PRIMITIVE_TOPOLOGY_LINE_LIST;
    case cases::Primitive::points:
      break;
  }
  return VK_PRIMITIVE_TOPOLOGY_POINT_LIST;
}

/// The structs that describe a pipeline, which point at each other and at the source.
struct Description {
  VkVertexInputBindingDescription binding{};
  VkPipelineVertexInputStateCreateInfo vertices{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineViewportDepthClipControlCreateInfoEXT clip_control{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationProvokingVertexStateCreateInfoEXT provoking{};
  VkPipelineRasterizationLineStateCreateInfoEXT lines{};
  VkPipelineRasterizationStateCreateInfo rasterization{};
  VkPipelineMultisampleStateCreateInfo multisampling{
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      nullptr,
      0,
      VK_SAMPLE_COUNT_1_BIT,
      VK_FALSE,
      0,
      nullptr,
      VK_FALSE,
      VK_FALSE};
  VkPipelineDepthStencilStateCreateInfo depth{};
  std::vector<VkPipelineColorBlendAttachmentState> attachments;
  VkPipelineColorBlendStateCreateInfo blending{};
  VkPipelineDynamicStateCreateInfo dynamic{};
  VkPipelineRenderingCreateInfo rendering{};

  explicit Description(const PipelineSource& source);
  Description(const Description&) = delete;
  Description& operator=(const Description&) = delete;
  ~Description() = default;

 private:
  void describe_vertices(const PipelineSource& source);
  void describe_rasterization(const PipelineSource& source);
  void describe_output(const PipelineSource& source);
};

Description::Description(const PipelineSource& source) {
  describe_vertices(source);
  describe_rasterization(source);
  describe_output(source);
  static constexpr std::array kDynamic{
      VK_DYNAMIC_STATE_VIEWPORT,         VK_DYNAMIC_STATE_SCISSOR,
      VK_DYNAMIC_STATE_CULL_MODE,        VK_DYNAMIC_STATE_FRONT_FACE,
      VK_DYNAMIC_STATE_DEPTH_COMPARE_OP, VK_DYNAMIC_STATE_DEPTH_BIAS_ENABLE,
      VK_DYNAMIC_STATE_DEPTH_BIAS,       VK_DYNAMIC_STATE_LINE_WIDTH};
  const bool is_of_lines = source.primitive == cases::Primitive::lines;
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = kDynamic.size() - (is_of_lines ? 0 : 1);  // all but the last
  dynamic.pDynamicStates = kDynamic.data();
}

void Description::describe_vertices(const PipelineSource& source) {
  binding = {0, source.vertex_size, VK_VERTEX_INPUT_RATE_VERTEX};
  vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  vertices.vertexBindingDescriptionCount = 1;
  vertices.pVertexBindingDescriptions = &binding;
  vertices.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(source.inputs.size());
  vertices.pVertexAttributeDescriptions = source.inputs.data();
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = topology_of(source.primitive, source.topology);
  // Restarts in lists need an extension.
  assembly.primitiveRestartEnable =
      source.topology == cases::Topology::triangles ? VK_FALSE : VK_TRUE;
}

void Description::describe_rasterization(const PipelineSource& source) {
  clip_control.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_DEPTH_CLIP_CONTROL_CREATE_INFO_EXT;
  clip_control.negativeOneToOne = VK_TRUE;
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  provoking.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT;
  provoking.provokingVertexMode = VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT;
  rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  rasterization.depthClampEnable = source.depth_clamp ? VK_TRUE : VK_FALSE;
  rasterization.polygonMode = VK_POLYGON_MODE_FILL;
  rasterization.lineWidth = 1;
  if (source.negative_one_to_one) viewport.pNext = &clip_control;
  if (source.provoking_last) rasterization.pNext = &provoking;
  if (source.line_mode == VK_LINE_RASTERIZATION_MODE_DEFAULT_EXT) return;
  lines.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_LINE_STATE_CREATE_INFO_EXT;
  lines.lineRasterizationMode = source.line_mode;
  lines.pNext = std::exchange(rasterization.pNext, &lines);
}

void Description::describe_output(const PipelineSource& source) {
  multisampling.rasterizationSamples = static_cast<VkSampleCountFlagBits>(source.samples);
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = source.depth != VK_FORMAT_UNDEFINED ? VK_TRUE : VK_FALSE;
  depth.depthWriteEnable = source.writes_depth ? depth.depthTestEnable : VK_FALSE;
  attachments.assign(source.colors.size(), attachment_state(source.blend));
  blending.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blending.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  blending.pAttachments = attachments.data();
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(source.colors.size());
  rendering.pColorAttachmentFormats = source.colors.data();
  rendering.depthAttachmentFormat = source.depth;
}

}  // namespace

VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits which, const ShaderModule& module,
                                         const VkSpecializationInfo* constants) {
  return {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          nullptr,
          0,
          which,
          module.get(),
          "main",
          constants};
}

Result<ShaderModule> make_module(const Device& device, std::span<const std::uint32_t> words) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = words.size_bytes();
  info.pCode = words.data();
  return make_object<ShaderModule>("vkCreateShaderModule", &vkCreateShaderModule, device.get(),
                                   info);
}

Result<PipelineLayout> make_empty_layout(const Device& device) {
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  return make_object<PipelineLayout>("vkCreatePipelineLayout", &vkCreatePipelineLayout,
                                     device.get(), info);
}

Result<Pipeline> make_pipeline(const Device& device, VkPipelineLayout layout,
                               const PipelineSource& source) {
  const Result<ShaderModule> vertex = make_module(device, source.vertex_shader);
  if (!vertex) return tl::unexpected(vertex.error());
  const Result<ShaderModule> fragment = make_module(device, source.fragment_shader);
  if (!fragment) return tl::unexpected(fragment.error());
  const Description description(source);
  const std::array stages{
      stage_of(VK_SHADER_STAGE_VERTEX_BIT, *vertex),
      stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, *fragment, source.fragment_constants)};
  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = &description.rendering;
  info.stageCount = stages.size();
  info.pStages = stages.data();
  info.pVertexInputState = &description.vertices;
  info.pInputAssemblyState = &description.assembly;
  info.pViewportState = &description.viewport;
  info.pRasterizationState = &description.rasterization;
  info.pMultisampleState = &description.multisampling;
  info.pDepthStencilState = &description.depth;
  info.pColorBlendState = &description.blending;
  info.pDynamicState = &description.dynamic;
  info.layout = layout;
  VkPipeline handle = VK_NULL_HANDLE;
  const VkResult result =
      vkCreateGraphicsPipelines(device.get(), VK_NULL_HANDLE, 1, &info, nullptr, &handle);
  if (result != VK_SUCCESS) return failed("vkCreateGraphicsPipelines", result);
  return Pipeline(device.get(), handle);
}

}  // namespace rastercheck::backends::vulkan
