#pragma once

#include <vulkan/vulkan_core.h>

#include <string>

#include "cases/error.h"

namespace rastercheck::backends::vulkan {

tl::unexpected<Error> failed(const std::string& reason, Failure failure = Failure::refused);

/// The error for a call that failed.
tl::unexpected<Error> failed(const char* call, VkResult result);

/// Fails unless the result is VK_SUCCESS.
Result<void> check(const char* call, VkResult result);

}  // namespace rastercheck::backends::vulkan
