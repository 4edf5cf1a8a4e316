#pragma once

// What a campaign on several backends keeps to show them side by side (records/side_by_side.h).

#include <span>
#include <vector>

#include "cases/case.h"
#include "properties/campaign/findings.h"
#include "records/case_outcomes.h"
#include "records/plan.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Notes in a task's findings which of its judged cases are other ones on earlier backends of the
/// plan. Makes the cases again for backends with other capabilities; the rest need no look.
void note_unlike_cases(const records::Plan& plan, std::span<const cases::Case> corpus,
                       Findings& findings);

/// Returns the first case of each disagreement of two backends, in the order of
/// records::side_by_side(). Draws nothing. Leaves out cases that no longer exist.
std::vector<records::Difference> differences_of(const records::Run& run,
                                                std::span<const cases::Case> corpus);

}  // namespace rastercheck::properties
