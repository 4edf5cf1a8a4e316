#pragma once

// A sample of a drawing, and the pixels around it, looked at closely: what is exactly true, what
// was drawn, and how the one became the other.

#include <cstdint>
#include <optional>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "oracle/pixel_box.h"
#include "properties/inspect/focus.h"
#include "records/inspection.h"

namespace rastercheck::properties {

struct InspectOptions {
  /// Values, depths among them, that are shown of the pixels around the sample, at most; those of
  /// the sample's own pixel are shown however many they are.
  std::uint32_t most_values = 4096;
  /// The pixels that are shown, however many; nothing: those that the triangle touches. The sample
  /// is among them.
  std::optional<oracle::PixelBox> crop = std::nullopt;
};

/// Draws the case's clip positions (oracle/transform.h), without the depth test, which has no say
/// in how a triangle is drawn, and holds the focus' triangle against what the backend promises.
/// Occasion, law and names are the caller's to fill in. Fails where the case cannot be drawn, or
/// has no such triangle, pixel, sample or attribute; the reason is one line.
Result<records::Inspection> inspect(const cases::Case& c, backends::Backend& backend,
                                    const Focus& focus, const InspectOptions& options = {});

}  // namespace rastercheck::properties
