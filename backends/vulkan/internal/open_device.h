#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/internal/device.h"

namespace rastercheck::backends::vulkan {

/// Opens what stands behind the colon of a specification: nothing for the machine's best device,
/// its index, a part of its name, or the name of a driver that draws on the CPU; `,validate` behind
/// these, or alone, for the validation layer. Fails where there is none, as Failure::unavailable.
Result<Device> open_device(const std::string& options);

/// The drivers that are known by name.
std::vector<std::string_view> driver_names();

}  // namespace rastercheck::backends::vulkan
