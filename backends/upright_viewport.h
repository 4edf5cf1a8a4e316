#pragma once

// Viewports of negative size, which neither API has, but Vulkan for heights: what is drawn there is
// what a viewport turned round draws of negated coordinates.

#include <optional>

#include "cases/case.h"

namespace rastercheck::backends {

/// Which sizes of a viewport a driver takes below 0.
enum class NegativeSizes { none, height };

/// The case with its viewport turned round, and coordinates negated, along each axis whose size is
/// negative and that the driver does not turn by itself. Every window position is the same number
/// as before, and so is the way that triangles face. Nothing where there is nothing to turn, or
/// where the viewport's other side is no float32.
std::optional<cases::Case> with_upright_viewport(const cases::Case& c, NegativeSizes taken);

}  // namespace rastercheck::backends
