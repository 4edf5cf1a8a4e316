#pragma once

#include <cstdint>
#include <string>

#include "backends/backend.h"

namespace rastercheck::backends::vulkan {

/// What a device says of its driver (VkPhysicalDeviceDriverProperties).
struct DriverFacts {
  std::uint32_t id = 0;  ///< VkDriverId
  std::string name;
  std::string info;
  std::uint32_t version = 0;  ///< packed by the driver, which may do that in its own way
};

/// The driver by the name of its project, lower case: "lavapipe", which calls itself llvmpipe,
/// "swiftshader", "radv", "anv", "nvidia"; of others the first word of their own name. The version
/// is the one in its information, "Mesa 22.3.6", or where there is none the packed one, "5.0.0".
Driver driver_named(const DriverFacts& facts);

}  // namespace rastercheck::backends::vulkan
