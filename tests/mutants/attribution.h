#pragma once

// Which stage of a mutant the exact split of its errors blames (oracle/stage_split.h).

#include <optional>
#include <string_view>

#include "backends/backend.h"
#include "cases/case.h"
#include "records/stage_split.h"

namespace rastercheck::mutants {

/// Of the first violation of a law that judges all samples or all values of a case: the stage with
/// the largest part of the value's error, or the first that says otherwise of the sample than the
/// rules. Nothing where there is no violation, or none whose trace tells.
std::optional<records::Stage> blamed_stage(std::string_view law, const cases::Case& source,
                                           backends::Backend& mutant);

}  // namespace rastercheck::mutants
