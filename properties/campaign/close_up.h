#pragma once

// Shows the pixels around a violation as signs, for terminals and plain text.

#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// Draws the case and shows the pixels around a violation. Each pixel's sign tells how the contract
/// judges the violation's triangle there, at the sample of the pixel that has the violation's
/// sample index. The violation is in brackets:
///
///   y     3    .   .   #   #   .
///   y     4    .   #  [-]  #   .
///      x       1   2   3   4   5
///   # drawn as it has to be   . not drawn, rightly   - missing
///
/// Then explains the signs that occur. Says so if the violation is from another drawing, or if the
/// contract differs from what the case asks for. Empty if the case cannot be drawn.
std::vector<std::string> close_up(const cases::Case& c, backends::Backend& backend,
                                  const records::Violation& violation);

}  // namespace rastercheck::properties
