#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Decides which triangles are not drawn, in every mode of coverage.

#include <cstddef>
#include <optional>

#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Returns a triangle of the mesh; empty if a position or clip distance of the triangle is not
/// finite.
std::optional<InputTriangle> input_triangle(const State& state, const Mesh& mesh,
                                            std::size_t index);

/// Counts a triangle in `counts` if its fate is one that DrawCounts reports.
void count(Fate fate, DrawCounts& counts);

// An orientation is 1 if a triangle turns from window u to v, else −1.

/// True if a triangle with this orientation is a front face.
bool is_front_face(const State& state, int orientation);
/// True if a triangle with this orientation is culled.
bool is_culled(const State& state, int orientation);

}  // namespace rastercheck::rasterizer
