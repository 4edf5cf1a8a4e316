#pragma once

// Lists what may be drawn, sample by sample, for those who check a drawing without this program.

#include <vector>

#include "backends/backend.h"
#include "cases/clip_case.h"
#include "records/exhibit.h"

namespace rastercheck::properties {

/// The samples of the inspected part, what may be drawn there by the drawing's contract, and
/// whether the drawing has that. If all triangles together have more than `most_samples` samples
/// there, only those of the inspected triangle. Omits samples where any result is allowed.
std::vector<records::JudgedPlace> judged_places(const cases::ClipCase& c,
                                                const backends::Drawn& drawn,
                                                const records::Inspection& part,
                                                std::size_t most_samples = 1U << 14U);

}  // namespace rastercheck::properties
