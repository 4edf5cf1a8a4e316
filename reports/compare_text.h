#pragma once

// A gate's outcome for people, on a terminal.

#include <string>
#include <vector>

#include "reports/compare_format.h"

namespace rastercheck::reports {

/// Of each comparison the verdict, the entries that are worse, the largest growths of cases, the
/// stages whose part grew, what is better; then what the policy says. Lines of at most 80
/// characters but for names and commands. `quiet`: verdicts and worse entries only.
std::string comparison_text(const Gate& gate, bool quiet);

/// What changed, one line each: "LAW: smooth, sliver: worst 0.5 → 0.731 ULP".
std::vector<std::string> change_lines(const std::vector<records::EntryChange>& entries);

}  // namespace rastercheck::reports
