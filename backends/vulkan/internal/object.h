#pragma once

#include <vulkan/vulkan_core.h>

#include <utility>

#include "backends/vulkan/internal/error.h"

namespace rastercheck::backends::vulkan {

/// Owns a Vulkan object and destroys it. The device must outlive it.
template <typename Handle, auto destroy>
class Object {
 public:
  Object() = default;
  Object(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
  Object(Object&& other) noexcept
      : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;
  ~Object() {
    if (handle_ != VK_NULL_HANDLE) destroy(device_, handle_, nullptr);
  }

  Handle get() const { return handle_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  Handle handle_ = VK_NULL_HANDLE;
};

using Buffer = Object<VkBuffer, &vkDestroyBuffer>;
using CommandPool = Object<VkCommandPool, &vkDestroyCommandPool>;
using DescriptorPool = Object<VkDescriptorPool, &vkDestroyDescriptorPool>;
using DescriptorSetLayout = Object<VkDescriptorSetLayout, &vkDestroyDescriptorSetLayout>;
using Fence = Object<VkFence, &vkDestroyFence>;
using Image = Object<VkImage, &vkDestroyImage>;
using ImageView = Object<VkImageView, &vkDestroyImageView>;
using Memory = Object<VkDeviceMemory, &vkFreeMemory>;
using Pipeline = Object<VkPipeline, &vkDestroyPipeline>;
using PipelineLayout = Object<VkPipelineLayout, &vkDestroyPipelineLayout>;
using Sampler = Object<VkSampler, &vkDestroySampler>;
using ShaderModule = Object<VkShaderModule, &vkDestroyShaderModule>;

/// Makes an object with a function such as vkCreateImage, whose name is `call`.
template <typename Made, typename Make, typename Info>
Result<Made> make_object(const char* call, Make make, VkDevice device, const Info& info) {
  decltype(Made().get()) handle = VK_NULL_HANDLE;
  if (const VkResult result = make(device, &info, nullptr, &handle); result != VK_SUCCESS) {
    return failed(call, result);
  }
  return Made(device, handle);
}

}  // namespace rastercheck::backends::vulkan
