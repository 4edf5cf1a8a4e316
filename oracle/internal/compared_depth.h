#pragma once

// The depths that a depth test compares, and how far the contract lets them be from the exact ones.

#include <optional>

#include "oracle/internal/number.h"
#include "oracle/internal/triangle_setup.h"
#include "oracle/triangle_truth.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// The largest difference between a compared depth and the exact one, in units of depth. It is the
/// contract's bound plus one step of the format, because the depth may be rounded to either
/// neighbour.
Field depth_slack(const TriangleSetup& triangle);
/// Like depth_slack(), but in double, and no smaller.
double near_depth_slack(const TriangleSetup& triangle);

/// The depths that a backend may compare for a triangle's fragment at a sample; empty if any depth
/// is right. The sample must not be forbidden.
std::optional<FieldRange> compared_depths(const TriangleTruth& truth, int x, int y, int sample);

/// Encloses `depths` widened by `slack` on both sides; NaN if `slack` is.
records::Enclosure widened_depths(const records::Enclosure& depths, double slack);

}  // namespace rastercheck::oracle
