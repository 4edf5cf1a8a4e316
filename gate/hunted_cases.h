#pragma once

// Adds the worst cases of a hunt to a baseline, so that every later run is held against them.

#include <string>
#include <vector>

#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/plan_run.h"
#include "records/baseline.h"

namespace rastercheck::gate {

/// The most characters of a plan as JSON: it is an argument of worker processes, and Linux allows
/// 131,072 bytes for one. The rest is room for what a later run adds.
inline constexpr std::size_t kMostPlanCharacters = 100'000;

/// Checks `worst` with all properties of the section, by `backend` as `conduct` makes it, and adds
/// the cases and their figures to the section. Its other figures stay as they are. Fails if the
/// corpus cannot be read or is another than the section's, if the oracle fails, or if the section
/// would have too many cases.
Result<void> add_hunted(records::BaselineSection& section, const std::string& backend,
                        const std::vector<cases::Case>& worst, const properties::Conduct& conduct);

}  // namespace rastercheck::gate
