#include "backends/vulkan/internal/commands.h"

#include <cstdint>
#include <utility>

namespace rastercheck::backends::vulkan {

Result<Commands> Commands::create(const Device& device) {
  VkCommandPoolCreateInfo pool_info{};
  pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool_info.queueFamilyIndex = device.queue_family();
  Result<CommandPool> pool = make_object<CommandPool>("vkCreateCommandPool", &vkCreateCommandPool,
                                                      device.get(), pool_info);
  if (!pool) return tl::unexpected(pool.error());
  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  Result<Fence> fence =
      make_object<Fence>("vkCreateFence", &vkCreateFence, device.get(), fence_info);
  if (!fence) return tl::unexpected(fence.error());
  Commands commands;
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool->get();
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  const VkResult allocated = vkAllocateCommandBuffers(device.get(), &info, &commands.buffer_);
  if (allocated != VK_SUCCESS) return failed("vkAllocateCommandBuffers", allocated);
  commands.pool_ = *std::move(pool);
  commands.fence_ = *std::move(fence);
  return commands;
}

Result<void> Commands::run(const Device& device,
                           const std::function<void(VkCommandBuffer)>& record) {
  Result<void> reset =
      check("vkResetCommandPool", vkResetCommandPool(device.get(), pool_.get(), 0));
  if (!reset) return reset;
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  Result<void> begun = check("vkBeginCommandBuffer", vkBeginCommandBuffer(buffer_, &begin));
  if (!begun) return begun;
  record(buffer_);
  Result<void> ended = check("vkEndCommandBuffer", vkEndCommandBuffer(buffer_));
  if (!ended) return ended;

  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &buffer_;
  const VkFence done = fence_.get();
  Result<void> submitted = check("vkQueueSubmit", vkQueueSubmit(device.queue(), 1, &info, done));
  if (!submitted) return submitted;
  Result<void> waited =
      check("vkWaitForFences", vkWaitForFences(device.get(), 1, &done, VK_TRUE, ~std::uint64_t{0}));
  if (!waited) return waited;
  return check("vkResetFences", vkResetFences(device.get(), 1, &done));
}

}  // namespace rastercheck::backends::vulkan
