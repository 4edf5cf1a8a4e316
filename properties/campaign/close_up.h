#pragma once

// A violation to look at: the pixels around it as signs, for a terminal and for plain text.

#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// Draws the case and shows what its contract makes of the violation's triangle and sample, in the
/// pixels around the violation, which is in brackets:
///
///   y     3    .   .   #   #   .
///   y     4    .   #  [-]  #   .
///      x       1   2   3   4   5
///   # drawn as it has to be   . not drawn, rightly   - missing
///
/// and names the signs that occur; then, where it is so, that the violation is of another drawing,
/// and that the contract is not what the case asks for. Empty where the case cannot be drawn.
std::vector<std::string> close_up(const cases::Case& c, backends::Backend& backend,
                                  const records::Violation& violation);

}  // namespace rastercheck::properties
