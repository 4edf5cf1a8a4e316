#pragma once

// The part of a drawing that is looked at.

#include <cstdint>

#include "cases/case.h"
#include "cases/sample_place.h"
#include "oracle/pixel_box.h"
#include "records/stage_trace.h"

namespace rastercheck::properties {

/// The pixels that either has; of an empty one the other.
oracle::PixelBox hull(const oracle::PixelBox& a, const oracle::PixelBox& b);

/// What `touched` covers and a margin around it, within the framebuffer; of more than `most_values`
/// values, depths among them, a square part, with the sample as near to its middle as may be. At
/// least a pixel, at most records::kMostInspected along either side.
oracle::PixelBox crop_around(const cases::Case& c, const oracle::PixelBox& touched,
                             const cases::SamplePlace& at, std::uint32_t most_values);

}  // namespace rastercheck::properties
