#pragma once

// Finds the stage of a mutant that the exact split of its errors blames (oracle/stage_split.h).

#include <optional>
#include <string_view>

#include "backends/backend.h"
#include "cases/case.h"
#include "records/stage_split.h"

namespace rastercheck::mutants {

/// Checks the case by a law that judges all samples or all values, and returns the stage to blame
/// for the first violation that can be attributed: the stage with the largest part of the value's
/// error, or the first stage that decides the sample differently from the rules. Empty if no
/// violation can be attributed.
std::optional<records::Stage> blamed_stage(std::string_view law, const cases::Case& source,
                                           backends::Backend& mutant);

}  // namespace rastercheck::mutants
