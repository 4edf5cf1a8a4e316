#include "backends/vulkan/internal/memory.h"

#include <optional>
#include <utility>

namespace rastercheck::backends::vulkan {
namespace {

/// The first allowed memory type that has all the properties.
std::optional<std::uint32_t> memory_type(const Device& device, std::uint32_t allowed,
                                         VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties properties{};
  vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties);
  for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    if ((allowed >> i & 1U) == 0) continue;
    if ((properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  }
  return std::nullopt;
}

Result<Memory> allocate(const Device& device, const VkMemoryRequirements& requirements,
                        std::initializer_list<VkMemoryPropertyFlags> best_first) {
  std::optional<std::uint32_t> type;
  for (const VkMemoryPropertyFlags wanted : best_first) {
    if (!type) type = memory_type(device, requirements.memoryTypeBits, wanted);
  }
  if (!type) return failed("the device has no host-visible memory");
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = *type;
  return make_object<Memory>("vkAllocateMemory", &vkAllocateMemory, device.get(), info);
}

}  // namespace

Result<HostBuffer> make_host_buffer(const Device& device, std::size_t size,
                                    VkBufferUsageFlags usage) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage;
  Result<Buffer> buffer =
      make_object<Buffer>("vkCreateBuffer", &vkCreateBuffer, device.get(), info);
  if (!buffer) return tl::unexpected(buffer.error());
  VkMemoryRequirements requirements{};
  vkGetBufferMemoryRequirements(device.get(), buffer->get(), &requirements);
  // Cached memory is preferred, since reads from uncached memory are slow.
  constexpr VkMemoryPropertyFlags kCoherent =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  Result<Memory> memory =
      allocate(device, requirements, {kCoherent | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kCoherent});
  if (!memory) return tl::unexpected(memory.error());
  const Result<void> bound = check(
      "vkBindBufferMemory", vkBindBufferMemory(device.get(), buffer->get(), memory->get(), 0));
  if (!bound) return tl::unexpected(bound.error());
  void* mapped = nullptr;
  const Result<void> is_mapped =
      check("vkMapMemory", vkMapMemory(device.get(), memory->get(), 0, VK_WHOLE_SIZE, 0, &mapped));
  if (!is_mapped) return tl::unexpected(is_mapped.error());
  return HostBuffer{*std::move(memory), *std::move(buffer),
                    std::span(static_cast<std::byte*>(mapped), size)};
}

Result<DeviceImage> make_image(const Device& device, const VkImageCreateInfo& info) {
  Result<Image> image = make_object<Image>("vkCreateImage", &vkCreateImage, device.get(), info);
  if (!image) return tl::unexpected(image.error());
  VkMemoryRequirements requirements{};
  vkGetImageMemoryRequirements(device.get(), image->get(), &requirements);
  Result<Memory> memory = allocate(device, requirements, {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0});
  if (!memory) return tl::unexpected(memory.error());
  const Result<void> bound =
      check("vkBindImageMemory", vkBindImageMemory(device.get(), image->get(), memory->get(), 0));
  if (!bound) return tl::unexpected(bound.error());
  return DeviceImage{*std::move(memory), *std::move(image)};
}

}  // namespace rastercheck::backends::vulkan
