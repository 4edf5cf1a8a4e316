#pragma once

// The way in which a case fails. One counterexample per way is kept, so that none hides another.

#include <string>
#include <string_view>

#include "cases/case.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// Describes a violation of a case in `found`. Sets `verdict` to its class, `kind` to what is
/// wrong, and `condition` to what is special about the fragment, the first of these that holds:
///
///   tie              the sample lies exactly on the edge or plane that decides its coverage
///   clamped          depth is wrong, and the triangle reaches beyond the range to which depth is
///                    clamped
///   clipped          a vertex lies beyond a clip plane or clip distance, or has w <= 0
///   several samples  pixels have several samples
///   ordinary         none of these, or the case has no clip positions
///
/// `kind` and `condition` are empty if nothing was drawn.
void set_failure(cases::Found& found, const cases::Case& c, const records::Violation& violation);

/// In a plugin's message, replaces each word that contains a digit by "#": numbers may differ in
/// each case, and reasons are counted by text.
std::string without_numbers(std::string_view why);

}  // namespace rastercheck::properties
