#pragma once

#include <array>

#include "backends/internal/view_clipping.h"
#include "cases/case.h"

namespace rastercheck::backends {

/// K of the affine weights (cases::ValueBound) at the corner of the viewport that is farthest from
/// the window's origin, where K is greatest.
double condition_of(const cases::Viewport& viewport, const std::array<Vertex, 3>& triangle);

}  // namespace rastercheck::backends
