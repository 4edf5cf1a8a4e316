#pragma once

// Outlines of triangles for pictures, in rounded doubles.

#include <cstddef>
#include <vector>

#include "oracle/triangle_truth.h"
#include "records/inspection.h"

namespace rastercheck::properties {

/// Returns the corners, in window pixels, of the part of a triangle in front of the eye (w > 0) and
/// within a guard band around the framebuffer, as wide as the framebuffer. Gives the vertices in
/// order if that is the whole triangle, else the corners in order around the part; empty if nothing
/// is left. The scene must have no camera; `triangle` is an index into its triangles.
std::vector<records::WindowPoint> outline_of(const oracle::SceneTruth& scene, std::size_t triangle);

}  // namespace rastercheck::properties
