#include "backends/vulkan/internal/error.h"

#include <fmt/format.h>

// The C header has no names of results; this one has, and is compiled here only.
#define VULKAN_HPP_NO_EXCEPTIONS
#include <vulkan/vulkan.hpp>

namespace rastercheck::backends::vulkan {

tl::unexpected<Error> failed(const std::string& reason, Failure failure) {
  return tl::unexpected(Error{"", "", reason, failure});
}

tl::unexpected<Error> failed(const char* call, VkResult result) {
  return failed(fmt::format("{} gave {}", call, vk::to_string(static_cast<vk::Result>(result))));
}

Result<void> check(const char* call, VkResult result) {
  if (result == VK_SUCCESS) return {};
  return failed(call, result);
}

}  // namespace rastercheck::backends::vulkan
