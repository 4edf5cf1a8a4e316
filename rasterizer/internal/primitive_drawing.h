#pragma once

// Serves lines and points, as fragments and in frames, shaded ones included (docs/rasterizer.md,
// Routes).
//
// Draws lines and points sample by sample. Samples are covered and values computed as exact
// arithmetic does it (line_shape.h, primitive_values.h). A line is cut where the depth planes, user
// clip distances, the viewport's sides or the eye cut the line through the middle of it, by the
// weights of its ends: g_a E_a + g_b E_b >= 0. A point is drawn whole or, if its vertex is outside
// or behind the eye, not at all.
//
// With State::snapping, lines and points all of whose vertices are inside are snapped; others are
// drawn as if State had none.

#include <memory>

#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/internal/fallback_drawing.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// Makes the drawing of a mesh's lines or points. The arguments must have been checked and must
/// outlive it.
std::unique_ptr<FallbackDrawing> make_primitive_drawing(const DrawSetting& setting,
                                                        const Mesh& mesh);

/// Appends the fragments of every line or point.
DrawCounts draw_primitives(const State& state, const Mesh& mesh, const TargetSize& size,
                           Fragments& fragments);

}  // namespace rastercheck::rasterizer
