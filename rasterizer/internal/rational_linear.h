#pragma once

// The method rational-linear by name, for those who must not depend on the registry having kept it.

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// See methods/rational_linear.cpp. The arguments were checked.
DrawCounts draw_rational_linear(const State& state, const Mesh& mesh, const TargetSize& size,
                                Fragments& fragments);

}  // namespace rastercheck::rasterizer
