#pragma once

// Measures how many faults a campaign would have noticed: makes some correct drawings wrong and
// judges them again under the same contract.

#include <cstdint>

#include "backends/backend.h"
#include "properties/campaign/check_case.h"
#include "properties/law.h"
#include "records/defect.h"
#include "records/plan.h"

namespace rastercheck::properties {

/// True if the drawing of a random case is to be made wrong, provided the law holds. True for one
/// in Plan::power cases of the laws that judge a plain drawing, kCoverageLaw and kValuesLaw.
/// Depends only on the plan's seed, the law and the index.
bool is_sabotaged(const records::Plan& plan, const Law& law, std::uint64_t index);

/// Draws again a case for which one of these laws held, applies each defect that changes the
/// drawing, one at a time, and records whether the judge notices the defect. Coverage defects are
/// applied to cases of kCoverageLaw, pure value defects to cases of kValuesLaw. Adds nothing if the
/// backend does not draw the case again.
void measure_power(const records::Plan& plan, const Law& law, backends::Backend& backend,
                   const cases::Case& source, records::Power& power);

}  // namespace rastercheck::properties
