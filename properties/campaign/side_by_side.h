#pragma once

// The data that a campaign on several backends keeps to show them side by side
// (records/side_by_side.h).

#include <span>
#include <vector>

#include "cases/case.h"
#include "properties/campaign/findings.h"
#include "records/case_outcomes.h"
#include "records/plan.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Records in a task's findings the judged cases for which an earlier backend of the plan got a
/// different case under the same number. Only backends with other capabilities can get different
/// cases, so cases are made again for these backends only.
void note_unlike_cases(const records::Plan& plan, std::span<const cases::Case> corpus,
                       Findings& findings);

/// Returns the first case of each disagreement of two backends, in the order of
/// records::side_by_side(). Draws nothing. Leaves out cases that no longer exist.
std::vector<records::Difference> differences_of(const records::Run& run,
                                                std::span<const cases::Case> corpus);

}  // namespace rastercheck::properties
