#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "backends/vulkan/internal/device.h"

namespace rastercheck::backends::vulkan {

/// Opens the device that the text after the colon of a specification names. The text is empty for
/// the machine's best device; otherwise it is a device's index, part of its name, or the name of a
/// driver that draws on the CPU. `,validate` after it, or `validate` alone, adds the validation
/// layer. A driver that draws on the CPU may end with `@` and its root (driver_root.h). Fails with
/// Failure::unavailable if no device fits.
Result<Device> open_device(const std::string& options);

/// The drivers that can be requested by name.
std::vector<std::string_view> driver_names();

}  // namespace rastercheck::backends::vulkan
