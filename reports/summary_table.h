#pragma once

// The table of a run, for people and for programs.

#include <string>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::reports {

/// One row per law and backend; errors in scale ULP.
std::string summary_table(const std::vector<records::LawSummary>& rows, bool quiet);

/// How many samples had which verdict, and what share of all answers each level of the oracle gave,
/// as lines.
std::string summary_counts(const std::vector<records::LawSummary>& rows);

/// The same as one JSON document, without its end of line, and with each row's "precision" by kind
/// and stratum, for which a terminal has no room.
std::string summary_json(const records::Run& run, const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
