#pragma once

// The diamond-exit rule of Bresenham's lines (OpenGL 4.6, section 14.5.1; RULES §10).
//
// A line selects a pixel if it meets the open diamond |x − x_c| + |y − y_c| < 1/2 around the
// pixel's centre, unless its end lies in that diamond. To decide ties, the line is first moved by
// −(ε, ε²), for an infinitely small ε: a diamond then owns its two right edges.
//
// Under D3D nothing is moved. A diamond also has its two lower edges with the corner between them
// and, for lines that are longer along y, its right corner (Direct3D 11.3 Functional Specification,
// section 3.4.3).

#include <array>

#include "oracle/internal/number.h"

namespace rastercheck::oracle {

/// A position in pixels.
using ExactPosition = std::array<Field, 2>;

/// True if the line from `from` to `to` selects pixel (x, y).
bool exits_diamond(const ExactPosition& from, const ExactPosition& to, int x, int y, bool is_d3d);

}  // namespace rastercheck::oracle
