#pragma once

// Which triangles are not drawn at all, whatever the method.

#include <cstdint>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Whether a vertex's position and clip distances are numbers.
bool is_finite(const State& state, const Mesh& mesh, std::uint32_t vertex);

/// Whether a triangle that turns that way from window u to v, 1 or −1, is culled.
bool is_culled(const State& state, int orientation);

}  // namespace rastercheck::rasterizer
