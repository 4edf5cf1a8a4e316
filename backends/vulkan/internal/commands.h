#pragma once

#include <vulkan/vulkan_core.h>

#include <functional>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"

namespace rastercheck::backends::vulkan {

/// Commands that are recorded, done, and waited for.
class Commands {
 public:
  static Result<Commands> create(const Device& device);

  /// Fails where memory runs out or the device is lost. Waits for as long as it takes: whoever
  /// waits for a case ends this process where that is too long.
  Result<void> run(const Device& device, const std::function<void(VkCommandBuffer)>& record);

 private:
  Commands() = default;

  CommandPool pool_;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;  ///< the pool's
  Fence fence_;
};

}  // namespace rastercheck::backends::vulkan
