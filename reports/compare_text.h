#pragma once

// Describes a gate's outcome, for a terminal.

#include <string>
#include <vector>

#include "reports/compare_format.h"

namespace rastercheck::reports {

/// For each comparison: the verdict, the worse entries, the cases that grew most, the stages whose
/// part grew, and what is better; then the findings of the policy. Lines have at most 80
/// characters, except for names and commands. If `quiet`, only verdicts and worse entries.
std::string comparison_text(const Gate& gate, bool quiet);

/// The changes, one per line: "LAW: smooth, sliver: worst 0.5 → 0.731 ULP".
std::vector<std::string> change_lines(const std::vector<records::EntryChange>& entries);

}  // namespace rastercheck::reports
