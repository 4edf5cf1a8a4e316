#pragma once

// Chooses the inspected part of a drawing.

#include <cstdint>

#include "cases/case.h"
#include "cases/sample_place.h"
#include "oracle/pixel_box.h"
#include "records/stage_trace.h"

namespace rastercheck::properties {

/// Returns the smallest box around both boxes; if one is empty, the other.
oracle::PixelBox hull(const oracle::PixelBox& a, const oracle::PixelBox& b);

/// Returns `touched` with a margin, clipped to the framebuffer. If the result has more than
/// `most_values` values (including depths), returns a square part with the sample as near to its
/// middle as possible. Each side is at least one pixel and at most records::kMostInspected pixels
/// long.
oracle::PixelBox crop_around(const cases::Case& c, const oracle::PixelBox& touched,
                             const cases::SamplePlace& at, std::uint32_t most_values);

}  // namespace rastercheck::properties
