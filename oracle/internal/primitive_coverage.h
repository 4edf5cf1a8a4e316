#pragma once

// The verdict of a sample of a line or a point (RULES §9, §10), decided exactly.

#include <array>

#include "oracle/internal/triangle_setup.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// The verdict of a point as if it were a sample, for a line or point about which something is
/// promised. Neither is cut off at the viewport, whose sides only clip the middle of a line and
/// drop points: what is wide may reach beyond.
records::SampleVerdict decide_primitive(const TriangleSetup& primitive, const Point& p);

/// The values, at the vertices and times w, of the functionals that are zero on the viewport's
/// sides and positive between them.
std::array<std::array<Ring, 3>, 4> values_at_sides(const TriangleSetup& primitive);

/// True if the viewport has no width or no height. Nothing is drawn then.
bool has_no_area(const Scene& scene);

/// True if a point's vertex lies beyond a clip plane, a clip distance or a side of the viewport, or
/// behind the eye. On a plane it is inside.
bool is_dropped(const TriangleSetup& point);

/// True if a vertex of a line lies beyond, or on, one of these, so that samples may be cut off.
bool is_cut(const TriangleSetup& line);

}  // namespace rastercheck::oracle
