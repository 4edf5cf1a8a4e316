#pragma once

// Replaces viewports of negative size: a turned viewport with negated coordinates draws the same.
// OpenGL supports no negative sizes, and Vulkan supports only negative heights.

#include <optional>

#include "cases/case.h"

namespace rastercheck::backends {

/// The negative viewport sizes that a driver accepts.
enum class NegativeSizes { none, height };

/// Turns the case's viewport, and negates coordinates, along each axis whose size is negative and
/// not accepted by the driver. Every window position and the facing of every triangle stay the
/// same. Returns nothing if no axis needs turning, or if float32 cannot hold the position of the
/// viewport's other side.
std::optional<cases::Case> with_upright_viewport(const cases::Case& c, NegativeSizes taken);

}  // namespace rastercheck::backends
