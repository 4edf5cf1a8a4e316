#include "backends/vulkan/internal/pipelines.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "backends/vulkan/internal/shaders.h"
#include "backends/vulkan/spirv.h"

namespace rastercheck::backends::vulkan {
namespace {

/// So many are kept: a driver has some hundred kilobytes of code for each.
constexpr std::size_t kKept = 128;

// Locations of shaders/case.vert.
constexpr std::uint32_t kNumberLocation = 1;
constexpr std::uint32_t kClipLocation = 2;
constexpr std::uint32_t kSlotLocation = 4;

std::uint32_t bytes(std::size_t floats) {
  return static_cast<std::uint32_t>(floats * sizeof(float));
}

/// Whatever the shader reads; what is not in the buffer begins where vertices do.
std::vector<VkVertexInputAttributeDescription> inputs_of(const PipelineKind& kind) {
  constexpr VkFormat kVector = VK_FORMAT_R32G32B32A32_SFLOAT;
  const VertexLayout layout = vertex_layout(kind);
  std::vector<VkVertexInputAttributeDescription> all{
      {0, 0, kVector, 0}, {kNumberLocation, 0, VK_FORMAT_R32_SFLOAT, bytes(kSlotSize)}};
  for (std::size_t i = 0; i * 4 < kind.clip_distances; ++i) {
    all.push_back({kClipLocation + static_cast<std::uint32_t>(i), 0, kVector,
                   bytes(layout.clip_distances + 4 * i)});
  }
  for (std::size_t i = 0; i < kMaxSlots; ++i) {
    const std::size_t begin = i < kind.slots.size() ? layout.slots + kSlotSize * i : 0;
    all.push_back({kSlotLocation + static_cast<std::uint32_t>(i), 0, kVector, bytes(begin)});
  }
  return all;
}

/// The parts of a pipeline's description, which point at each other.
struct Description {
  VkVertexInputBindingDescription binding{};
  std::vector<VkVertexInputAttributeDescription> inputs;
  VkPipelineVertexInputStateCreateInfo vertices{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineViewportDepthClipControlCreateInfoEXT clip_control{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationProvokingVertexStateCreateInfoEXT provoking{};
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
  std::vector<VkFormat> formats;
  VkPipelineRenderingCreateInfo rendering{};

  explicit Description(const PipelineKind& kind);
  Description(const Description&) = delete;
  Description& operator=(const Description&) = delete;
  ~Description() = default;

 private:
  void describe_vertices(const PipelineKind& kind);
  void describe_rasterization(const PipelineKind& kind);
  void describe_output(const PipelineKind& kind);
};

Description::Description(const PipelineKind& kind) {
  describe_vertices(kind);
  describe_rasterization(kind);
  describe_output(kind);
  static constexpr std::array kDynamic{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                       VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE,
                                       VK_DYNAMIC_STATE_DEPTH_COMPARE_OP};
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = kDynamic.size();
  dynamic.pDynamicStates = kDynamic.data();
}

void Description::describe_vertices(const PipelineKind& kind) {
  binding = {0, bytes(vertex_layout(kind).size), VK_VERTEX_INPUT_RATE_VERTEX};
  inputs = inputs_of(kind);
  vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  vertices.vertexBindingDescriptionCount = 1;
  vertices.pVertexBindingDescriptions = &binding;
  vertices.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(inputs.size());
  vertices.pVertexAttributeDescriptions = inputs.data();
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
}

void Description::describe_rasterization(const PipelineKind& kind) {
  clip_control.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_DEPTH_CLIP_CONTROL_CREATE_INFO_EXT;
  clip_control.negativeOneToOne = VK_TRUE;
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  provoking.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT;
  provoking.provokingVertexMode = VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT;
  rasterization.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  rasterization.depthClampEnable = kind.depth_clamp ? VK_TRUE : VK_FALSE;
  rasterization.polygonMode = VK_POLYGON_MODE_FILL;
  rasterization.lineWidth = 1;
  const auto has_flat = [](const Qualifier& q) {
    return q.interpolation == cases::Interpolation::flat;
  };
  if (kind.is_opengl) {
    viewport.pNext = &clip_control;
    // A device that has it not draws cases without flat attributes all the same.
    if (std::any_of(kind.slots.begin(), kind.slots.end(), has_flat)) {
      rasterization.pNext = &provoking;
    }
  }
}

void Description::describe_output(const PipelineKind& kind) {
  multisampling.rasterizationSamples = static_cast<VkSampleCountFlagBits>(kind.samples);
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = VK_TRUE;
  depth.depthWriteEnable = VK_TRUE;
  VkPipelineColorBlendAttachmentState attachment{};
  attachment.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                              VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  attachments.assign(kind.slots.size() + 1, attachment);
  blending.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blending.attachmentCount = static_cast<std::uint32_t>(attachments.size());
  blending.pAttachments = attachments.data();
  formats.assign(attachments.size(), kSlotFormat);
  formats[0] = kNumberFormat;
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
  rendering.pColorAttachmentFormats = formats.data();
  rendering.depthAttachmentFormat = kDepthFormat;
}

/// Which slots are to be evaluated at the centre, of pixels that have other places to do it at.
class Centers {
 public:
  explicit Centers(const PipelineKind& kind) {
    for (std::size_t i = 0; i < kind.slots.size(); ++i) {
      const Qualifier& q = kind.slots[i];
      const bool is_center = kind.samples > 1 && q.location == cases::Location::center &&
                             q.interpolation != cases::Interpolation::flat;
      values_[i] = is_center ? VK_TRUE : VK_FALSE;
      entries_[i] = {static_cast<std::uint32_t>(i),
                     static_cast<std::uint32_t>(i * sizeof(VkBool32)), sizeof(VkBool32)};
      any_ = any_ || is_center;
    }
    info_.mapEntryCount = static_cast<std::uint32_t>(kind.slots.size());
    info_.pMapEntries = entries_.data();
    info_.dataSize = sizeof values_;
    info_.pData = values_.data();
  }
  Centers(const Centers&) = delete;
  Centers& operator=(const Centers&) = delete;
  ~Centers() = default;

  bool any() const { return any_; }
  const VkSpecializationInfo* info() const { return any_ ? &info_ : nullptr; }

 private:
  std::array<VkBool32, kMaxSlots> values_{};
  std::array<VkSpecializationMapEntry, kMaxSlots> entries_{};
  VkSpecializationInfo info_{};
  bool any_ = false;
};

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which, const ShaderModule& module) {
  return {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          nullptr,
          0,
          which,
          module.get(),
          "main",
          nullptr};
}

}  // namespace

VertexLayout vertex_layout(const PipelineKind& kind) {
  VertexLayout layout;
  // Read as vectors of four.
  layout.slots = layout.clip_distances + (kind.clip_distances + 3) / 4 * 4;
  // Vertices are no shorter than what is read of them.
  layout.size = layout.slots + kSlotSize * kind.slots.size();
  return layout;
}

Result<ShaderModule> make_module(const Device& device, std::span<const std::uint32_t> words) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = words.size_bytes();
  info.pCode = words.data();
  return make_object<ShaderModule>("vkCreateShaderModule", &vkCreateShaderModule, device.get(),
                                   info);
}

Result<Pipelines> Pipelines::create(const Device& device) {
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  Result<PipelineLayout> layout = make_object<PipelineLayout>(
      "vkCreatePipelineLayout", &vkCreatePipelineLayout, device.get(), info);
  if (!layout) return tl::unexpected(layout.error());
  Pipelines pipelines;
  pipelines.layout_ = *std::move(layout);
  return pipelines;
}

Result<VkPipeline> Pipelines::get(const Device& device, const PipelineKind& kind) {
  if (const auto made = made_.find(kind); made != made_.end()) return made->second.get();
  if (made_.size() >= kKept) made_.clear();
  ShaderModule& vertex = vertex_[kind.clip_distances];
  if (vertex.get() == VK_NULL_HANDLE) {
    Result<ShaderModule> module = make_module(device, vertex_shader(kind.clip_distances));
    if (!module) return tl::unexpected(module.error());
    vertex = *std::move(module);
  }
  const Centers centers(kind);
  const Result<ShaderModule> fragment =
      make_module(device, qualified(fragment_shader(kind.slots.size(), centers.any()), kind.slots));
  if (!fragment) return tl::unexpected(fragment.error());

  const Description description(kind);
  std::array stages{stage(VK_SHADER_STAGE_VERTEX_BIT, vertex),
                    stage(VK_SHADER_STAGE_FRAGMENT_BIT, *fragment)};
  stages[1].pSpecializationInfo = centers.info();
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
  info.layout = layout_.get();
  VkPipeline handle = VK_NULL_HANDLE;
  const VkResult result =
      vkCreateGraphicsPipelines(device.get(), VK_NULL_HANDLE, 1, &info, nullptr, &handle);
  if (result != VK_SUCCESS) return failed("vkCreateGraphicsPipelines", result);
  made_[kind] = Pipeline(device.get(), handle);
  return handle;
}

}  // namespace rastercheck::backends::vulkan
