#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {

/// A fragment shader whose inputs at locations 0, 1… are `noperspective sample` vectors, with the
/// qualifiers given for these locations instead: an interface is no matter of specialization
/// constants, and every combination of seven slots would be too many shaders to build. Without a
/// slot at samples it asks for no shading of each sample either.
std::vector<std::uint32_t> qualified(std::span<const std::uint32_t> shader,
                                     std::span<const Qualifier> qualifiers);

}  // namespace rastercheck::backends::vulkan
