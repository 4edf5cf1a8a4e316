#pragma once

#include <span>
#include <vector>

#include "backends/factory.h"
#include "cases/case.h"
#include "gate/compare.h"
#include "gate/sections.h"
#include "records/closer_look.h"

namespace rastercheck::gate {

/// Draws again what a comparison found to be otherwise, by the current side's backend, as far as it
/// is here and draws as it did: the cases that grew most, and of the parts that the baseline kept
/// those that changed most. `corpus` is that of both sides.
std::vector<records::CloserLook> look_closer(const records::Comparison& comparison,
                                             const records::Baseline& before,
                                             const records::Baseline& after,
                                             std::span<const cases::Case> corpus,
                                             const backends::BackendFactory& backends);

}  // namespace rastercheck::gate
