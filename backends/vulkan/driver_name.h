#pragma once

#include <cstdint>
#include <string>

#include "backends/backend.h"

namespace rastercheck::backends::vulkan {

/// The information that a device gives about its driver (VkPhysicalDeviceDriverProperties).
struct DriverFacts {
  std::uint32_t id = 0;  ///< VkDriverId
  std::string name;
  std::string info;
  std::uint32_t version = 0;  ///< packed, possibly in a format of the driver's own
};

/// Names the driver by its project in lower case: "lavapipe" (which calls itself llvmpipe),
/// "swiftshader", "radv", "anv", "nvidia" and a few more; an unknown driver by the first word of
/// its own name. The version comes from the driver's info ("Mesa 22.3.6") or, if that is empty,
/// from the packed number ("5.0.0").
Driver driver_named(const DriverFacts& facts);

}  // namespace rastercheck::backends::vulkan
