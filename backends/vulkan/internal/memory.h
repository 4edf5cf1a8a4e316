#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <span>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"

namespace rastercheck::backends::vulkan {

/// A buffer that this process can also access.
struct HostBuffer {
  Memory memory;
  Buffer buffer;
  std::span<std::byte> bytes;
};
Result<HostBuffer> make_host_buffer(const Device& device, std::size_t size,
                                    VkBufferUsageFlags usage);

/// An image in the device's memory.
struct DeviceImage {
  Memory memory;
  Image image;
};
Result<DeviceImage> make_image(const Device& device, const VkImageCreateInfo& info);

}  // namespace rastercheck::backends::vulkan
