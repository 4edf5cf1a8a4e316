#pragma once

// The verdict of a sample (RULES §2, §3), decided exactly.

#include <optional>

#include "oracle/internal/triangle_setup.h"
#include "records/enclosure.h"
#include "records/verdict.h"

namespace rastercheck::oracle {

/// The verdict of a sample of any pixel, drawn as the scene's contract allows.
records::SampleVerdict decide(const TriangleSetup& triangle, int x, int y, int sample);

/// The verdict of a point as if it were a sample, whatever viewport and scissor say.
records::SampleVerdict decide_point(const TriangleSetup& triangle, const Point& p);

/// The signed distance from a point to the boundary that decides it, in pixels: the least over all
/// edges, clip functionals and viewport sides, positive inside. Of a triangle with several
/// placements: of the exact one. Nothing for a triangle without orientation.
std::optional<records::Enclosure> boundary_distance(const TriangleSetup& triangle, const Point& p);

}  // namespace rastercheck::oracle
