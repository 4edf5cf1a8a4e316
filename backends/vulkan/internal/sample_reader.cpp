#include "backends/vulkan/internal/sample_reader.h"

#include <array>
#include <utility>

#include "backends/vulkan/internal/pipeline.h"
#include "backends/vulkan/internal/shaders.h"

namespace rastercheck::backends::vulkan {
namespace {

constexpr std::uint32_t kGroup = 64;  ///< invocations per work group, as in the shader

Result<DescriptorSetLayout> make_bindings(const Device& device) {
  const std::array<VkDescriptorSetLayoutBinding, 2> bindings{{
      {0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
      {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
  }};
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = bindings.size();
  info.pBindings = bindings.data();
  return make_object<DescriptorSetLayout>("vkCreateDescriptorSetLayout",
                                          &vkCreateDescriptorSetLayout, device.get(), info);
}

Result<PipelineLayout> make_layout(const Device& device, VkDescriptorSetLayout bindings) {
  const VkPushConstantRange shape{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(SampleReader::Shape)};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &bindings;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &shape;
  return make_object<PipelineLayout>("vkCreatePipelineLayout", &vkCreatePipelineLayout,
                                     device.get(), info);
}

Result<Pipeline> make_pipeline(const Device& device, VkPipelineLayout layout) {
  const Result<ShaderModule> module = make_module(device, samples_shader());
  if (!module) return tl::unexpected(module.error());
  const VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                         nullptr,
                                         0,
                                         stage_of(VK_SHADER_STAGE_COMPUTE_BIT, *module),
                                         layout,
                                         VK_NULL_HANDLE,
                                         0};
  VkPipeline handle = VK_NULL_HANDLE;
  const VkResult result =
      vkCreateComputePipelines(device.get(), VK_NULL_HANDLE, 1, &info, nullptr, &handle);
  if (result != VK_SUCCESS) return failed("vkCreateComputePipelines", result);
  return Pipeline(device.get(), handle);
}

Result<DescriptorPool> make_pool(const Device& device, std::uint32_t sets) {
  const std::array<VkDescriptorPoolSize, 2> sizes{{
      {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, sets},
      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, sets},
  }};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = sets;
  info.poolSizeCount = sizes.size();
  info.pPoolSizes = sizes.data();
  return make_object<DescriptorPool>("vkCreateDescriptorPool", &vkCreateDescriptorPool,
                                     device.get(), info);
}

void write_set(const Device& device, VkDescriptorSet set, const SampleReader::Source& source) {
  const VkDescriptorImageInfo image{VK_NULL_HANDLE, source.image,
                                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  const VkDescriptorBufferInfo buffer{source.buffer, source.begin, source.size};
  std::array<VkWriteDescriptorSet, 2> writes{};
  for (std::uint32_t i = 0; i < writes.size(); ++i) {
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
  }
  writes[0].descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
  writes[0].pImageInfo = &image;
  writes[1].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  writes[1].pBufferInfo = &buffer;
  vkUpdateDescriptorSets(device.get(), writes.size(), writes.data(), 0, nullptr);
}

}  // namespace

Result<SampleReader> SampleReader::create(const Device& device) {
  SampleReader reader;
  Result<DescriptorSetLayout> bindings = make_bindings(device);
  if (!bindings) return tl::unexpected(bindings.error());
  reader.bindings_ = *std::move(bindings);
  Result<PipelineLayout> layout = make_layout(device, reader.bindings_.get());
  if (!layout) return tl::unexpected(layout.error());
  reader.layout_ = *std::move(layout);
  Result<Pipeline> pipeline = make_pipeline(device, reader.layout_.get());
  if (!pipeline) return tl::unexpected(pipeline.error());
  reader.pipeline_ = *std::move(pipeline);
  return reader;
}

Result<SampleReader::Bindings> SampleReader::bind(const Device& device,
                                                  std::span<const Source> sources) const {
  const auto count = static_cast<std::uint32_t>(sources.size());
  Result<DescriptorPool> pool = make_pool(device, count);
  if (!pool) return tl::unexpected(pool.error());
  Bindings made{*std::move(pool), std::vector<VkDescriptorSet>(count)};
  const std::vector<VkDescriptorSetLayout> layouts(count, bindings_.get());
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = made.pool.get();
  info.descriptorSetCount = count;
  info.pSetLayouts = layouts.data();
  const Result<void> allocated = check(
      "vkAllocateDescriptorSets", vkAllocateDescriptorSets(device.get(), &info, made.sets.data()));
  if (!allocated) return tl::unexpected(allocated.error());
  for (std::size_t i = 0; i < sources.size(); ++i) write_set(device, made.sets[i], sources[i]);
  return made;
}

void SampleReader::record(VkCommandBuffer commands, VkDescriptorSet source, const Shape& shape,
                          std::size_t layers) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1, &source, 0,
                          nullptr);
  vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof shape, &shape);
  const std::uint32_t row = shape.width * shape.samples;
  vkCmdDispatch(commands, (row + kGroup - 1) / kGroup, shape.height,
                static_cast<std::uint32_t>(layers));
}

}  // namespace rastercheck::backends::vulkan
