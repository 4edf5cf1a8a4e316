#pragma once

#include <vulkan/vulkan_core.h>

#include <functional>

#include "backends/vulkan/internal/device.h"
#include "backends/vulkan/internal/object.h"

namespace rastercheck::backends::vulkan {

/// Records commands, executes them and waits until they are done.
class Commands {
 public:
  static Result<Commands> create(const Device& device);

  /// Fails if memory runs out or the device is lost. The wait is unlimited: the process that asked
  /// for the drawing ends this one when it takes too long.
  Result<void> run(const Device& device, const std::function<void(VkCommandBuffer)>& record);

 private:
  Commands() = default;

  CommandPool pool_;
  VkCommandBuffer buffer_ = VK_NULL_HANDLE;  ///< owned by the pool
  Fence fence_;
};

}  // namespace rastercheck::backends::vulkan
