#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "backends/vulkan/slots.h"

namespace rastercheck::backends::vulkan {

/// Takes a fragment shader whose inputs at locations 0, 1… are `noperspective sample` vectors, and
/// replaces their qualifiers by the given ones. Specialization constants cannot change an
/// interface, and the combinations of qualifiers for seven slots would be too many shaders to
/// build. If no slot is evaluated at samples, also drops per-sample shading.
std::vector<std::uint32_t> qualified(std::span<const std::uint32_t> shader,
                                     std::span<const Qualifier> qualifiers);

}  // namespace rastercheck::backends::vulkan
