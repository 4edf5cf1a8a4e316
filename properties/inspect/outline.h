#pragma once

// Where a triangle is seen, for pictures: doubles, which round.

#include <cstddef>
#include <vector>

#include "oracle/triangle_truth.h"
#include "records/inspection.h"

namespace rastercheck::properties {

/// The corners, in window pixels, of what of a triangle is in front of the eye (w > 0) and within a
/// guard around the framebuffer, as wide as this: its vertices in their order where that is all of
/// it, else the corners in their order around it; none where nothing is left. The scene has no
/// camera; `triangle` is an index into its triangles.
std::vector<records::WindowPoint> outline_of(const oracle::SceneTruth& scene, std::size_t triangle);

}  // namespace rastercheck::properties
