#pragma once

#include <span>
#include <vector>

#include "backends/factory.h"
#include "cases/case.h"
#include "gate/compare.h"
#include "gate/sections.h"
#include "records/closer_look.h"

namespace rastercheck::gate {

/// Draws again, with the current side's backend, the cases that grew most and the kept parts of
/// drawings (records::Specimen) that changed most. Leaves out those that cannot be drawn here, or
/// are drawn differently now. `corpus` is the corpus of both sides.
std::vector<records::CloserLook> look_closer(const records::Comparison& comparison,
                                             const records::Baseline& before,
                                             const records::Baseline& after,
                                             std::span<const cases::Case> corpus,
                                             const backends::BackendFactory& backends);

}  // namespace rastercheck::gate
