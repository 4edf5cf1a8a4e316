#pragma once

// Where a triangle is seen, for pictures: doubles, which round.

#include <vector>

#include "cases/case.h"
#include "records/inspection.h"

namespace rastercheck::properties {

/// The corners, in window pixels, of what of a triangle is in front of the eye (w > 0) and within a
/// guard around the framebuffer, as wide as this: in the order of its vertices, none where nothing
/// is left. The case has no camera.
std::vector<records::WindowPoint> outline_of(const cases::Case& c, const cases::Triangle& triangle);

}  // namespace rastercheck::properties
