#pragma once

// How much a campaign would have noticed: some of what was drawn rightly is made wrong and judged
// again, under the same contract.

#include <cstdint>

#include "backends/backend.h"
#include "properties/campaign/check_case.h"
#include "properties/law.h"
#include "records/defect.h"
#include "records/plan.h"

namespace rastercheck::properties {

/// Whether the drawing of a random case is made wrong if the law holds of it: of one in Plan::power
/// cases of the laws that speak of whatever is drawn as it stands, kCoverageLaw and kValuesLaw.
/// Depends on the plan's seed, the law and the index alone.
bool is_sabotaged(const records::Plan& plan, const Law& law, std::uint64_t index);

/// Draws a case of which one of these laws held again, gives the drawing each defect that changes
/// it, one at a time, and adds whether it is noticed. Defects of which samples are drawn are for
/// cases of kCoverageLaw, those of values alone for cases of kValuesLaw. Adds nothing where the
/// backend does not draw the case again.
void measure_power(const records::Plan& plan, const Law& law, backends::Backend& backend,
                   const cases::Case& source, records::Power& power);

}  // namespace rastercheck::properties
