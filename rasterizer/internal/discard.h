#pragma once

// Which triangles are not drawn at all, whatever the method.

#include <cstddef>
#include <optional>

#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A triangle of the mesh; nothing where a position or clip distance of it is not finite.
std::optional<InputTriangle> input_triangle(const State& state, const Mesh& mesh,
                                            std::size_t index);

/// Counts a triangle that is left out and has to be told of.
void count(Fate fate, DrawCounts& counts);

/// Whether a triangle that turns that way from window u to v, 1 or −1, is culled.
bool is_culled(const State& state, int orientation);

}  // namespace rastercheck::rasterizer
