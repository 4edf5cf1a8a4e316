#pragma once

// In which way a case fails. One counterexample of each way is kept, so that none hides another.

#include <string>
#include <string_view>

#include "cases/case.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// Sets `verdict`, `kind` and `condition` to what a violation of a case is: its class, what is
/// wrong, and what is special of the fragment, the first that holds of
///
///   tie              the sample lies exactly on the boundary that decided
///   clamped          it is depth, and the triangle reaches beyond the range that depth is clamped
///                    to
///   clipped          a vertex lies beyond a clip plane or clip distance, or has w <= 0
///   several samples
///   ordinary         none of these, or the case has no clip positions
///
/// The last two are empty where there is no drawing.
void set_failure(cases::Found& found, const cases::Case& c, const records::Violation& violation);

/// Leaves out the words of a plugin's message that have numbers, which may be others in each case:
/// reasons are counted.
std::string without_numbers(std::string_view why);

}  // namespace rastercheck::properties
