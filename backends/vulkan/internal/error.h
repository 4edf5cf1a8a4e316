#pragma once

#include <vulkan/vulkan_core.h>

#include <string>

#include "cases/error.h"

namespace rastercheck::backends::vulkan {

tl::unexpected<Error> failed(const std::string& reason, Failure failure = Failure::refused);

/// Of a call that gave something else than success.
tl::unexpected<Error> failed(const char* call, VkResult result);

/// Nothing where it is success.
Result<void> check(const char* call, VkResult result);

}  // namespace rastercheck::backends::vulkan
