#include "backends/vulkan/internal/fragment_buffer.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace rastercheck::backends::vulkan {
namespace {

/// The most bytes of records that are processed at once.
constexpr std::size_t kMostBytes = std::size_t{64} << 20U;
constexpr std::size_t kWord = sizeof(std::uint32_t);

Result<DescriptorPool> make_records_pool(const Device& device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = 1;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  return make_object<DescriptorPool>("vkCreateDescriptorPool", &vkCreateDescriptorPool,
                                     device.get(), info);
}

}  // namespace

Result<FragmentBuffer> FragmentBuffer::create(const Device& device, const Pipelines& pipelines) {
  FragmentBuffer made;
  made.most_words_ = std::min(device.limits().max_storage, kMostBytes) / kWord - 1;
  Result<DescriptorPool> pool = make_records_pool(device);
  if (!pool) return tl::unexpected(pool.error());
  made.pool_ = *std::move(pool);
  const VkDescriptorSetLayout layout = pipelines.records_layout();
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = made.pool_.get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  const Result<void> allocated =
      check("vkAllocateDescriptorSets", vkAllocateDescriptorSets(device.get(), &info, &made.set_));
  if (!allocated) return tl::unexpected(allocated.error());
  return made;
}

Result<void> FragmentBuffer::make_room(const Device& device, std::size_t words) {
  const std::size_t bytes = (1 + words) * kWord;
  if (buffer_.bytes.size() < bytes) {
    buffer_ = {};
    const std::size_t rounded = std::min(std::bit_ceil(bytes), (1 + most_words_) * kWord);
    Result<HostBuffer> made = make_host_buffer(device, rounded, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    if (!made) return tl::unexpected(made.error());
    buffer_ = *std::move(made);
    const VkDescriptorBufferInfo whole{buffer_.buffer.get(), 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = &whole;
    vkUpdateDescriptorSets(device.get(), 1, &write, 0, nullptr);
  }
  std::memset(buffer_.bytes.data(), 0, kWord);
  return {};
}

void FragmentBuffer::bind(VkCommandBuffer commands, VkPipelineLayout layout,
                          std::size_t room) const {
  const auto records = static_cast<std::uint32_t>(room);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set_, 0,
                          nullptr);
  vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof records, &records);
}

void FragmentBuffer::show_host(VkCommandBuffer commands) {
  VkMemoryBarrier written{};
  written.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  written.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  written.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT,
                       0, 1, &written, 0, nullptr, 0, nullptr);
}

std::span<const std::uint32_t> FragmentBuffer::all_words() const {
  // The cast is safe, because memory is mapped at an address aligned for any type.
  return {reinterpret_cast<const std::uint32_t*>(buffer_.bytes.data()),
          buffer_.bytes.size() / kWord};
}

void begin_without_images(VkCommandBuffer commands, const cases::FramebufferSize& size) {
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea.extent = {static_cast<std::uint32_t>(size.width),
                            static_cast<std::uint32_t>(size.height)};
  info.layerCount = 1;
  vkCmdBeginRendering(commands, &info);
}

}  // namespace rastercheck::backends::vulkan
