#pragma once

#include <vector>

#include "oracle/pixel_box.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// Boxes of pixels that hold all samples that each triangle may cover, in the case's order; empty
/// boxes for triangles that the contract promises nothing about and for those that are certainly
/// culled. Computed in doubles, without an exact set-up; those of lines and points with one.
std::vector<PixelBox> boxes_of_triangles(const SceneTruth& scene);

/// The number of rows in a band: few enough to hold their samples in memory, and enough to amortise
/// setting up triangles.
int rows_of_band(const cases::FramebufferSize& size);

}  // namespace rastercheck::oracle
