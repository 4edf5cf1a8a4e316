#include "backends/vulkan/internal/error.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace rastercheck::backends::vulkan {
namespace {

// The C header has no names for results. The C++ header has them, but doubles the compile time.
constexpr std::array<std::pair<VkResult, const char*>, 10> kResultNames{{
    {VK_TIMEOUT, "VK_TIMEOUT"},
    {VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY"},
    {VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
    {VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED"},
    {VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST"},
    {VK_ERROR_MEMORY_MAP_FAILED, "VK_ERROR_MEMORY_MAP_FAILED"},
    {VK_ERROR_TOO_MANY_OBJECTS, "VK_ERROR_TOO_MANY_OBJECTS"},
    {VK_ERROR_EXTENSION_NOT_PRESENT, "VK_ERROR_EXTENSION_NOT_PRESENT"},
    {VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT"},
    {VK_ERROR_UNKNOWN, "VK_ERROR_UNKNOWN"},
}};

std::string result_name(VkResult result) {
  for (const auto& [value, name] : kResultNames) {
    if (value == result) return name;
  }
  return fmt::format("VkResult {}", static_cast<int>(result));
}

}  // namespace

tl::unexpected<Error> failed(const std::string& reason, Failure failure) {
  return tl::unexpected(Error{"", "", reason, failure});
}

tl::unexpected<Error> failed(const char* call, VkResult result) {
  return failed(fmt::format("{} returned {}", call, result_name(result)));
}

Result<void> check(const char* call, VkResult result) {
  if (result == VK_SUCCESS) return {};
  return failed(call, result);
}

}  // namespace rastercheck::backends::vulkan
