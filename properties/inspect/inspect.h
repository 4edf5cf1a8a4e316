#pragma once

// Inspects a sample of a drawing and the pixels around it: the exact answer, the drawn one, and how
// the difference arose.

#include <cstdint>
#include <optional>

#include "backends/backend.h"
#include "cases/clip_case.h"
#include "cases/error.h"
#include "oracle/pixel_box.h"
#include "properties/inspect/case_to_draw.h"
#include "properties/inspect/focus.h"
#include "records/inspection.h"

namespace rastercheck::properties {

struct InspectOptions {
  /// Maximum number of values shown around the sample, including depths; those of the sample's own
  /// pixel are always shown.
  std::uint32_t most_values = 4096;
  /// The pixels to show, without that limit; must contain the sample. Empty: the pixels that the
  /// triangle touches.
  std::optional<oracle::PixelBox> crop = std::nullopt;
};

/// Judges the triangle in focus by the drawing's contract. `c` is the case as drawn (case_to_draw),
/// `trace` the trace of the sample in focus. The caller fills in why the sample is inspected
/// (Inspection::occasion), the law and the names. Fails, with a reason of one line, if the case has
/// no such triangle, pixel, sample or attribute.
Result<records::Inspection> inspect(const cases::ClipCase& c, const backends::Drawn& drawn,
                                    const Focus& focus, const TracedSample& trace,
                                    const InspectOptions& options = {});

}  // namespace rastercheck::properties
