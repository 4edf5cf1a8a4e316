#pragma once

// The table of a run, for people and for programs.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::reports {

/// One row per law and backend; errors in scale ULP. `quiet` has no header, and is as wide as it
/// is; else as text_table() has it.
std::string summary_table(const std::vector<records::LawSummary>& rows, bool quiet,
                          std::optional<std::size_t> columns);

/// How many samples had which verdict, and what share of all answers each level of the oracle gave,
/// as lines.
std::string summary_counts(const std::vector<records::LawSummary>& rows);

/// How many cases each known defect of a backend was seen in, a line for each backend; empty where
/// none was.
std::string known_text(const records::Run& run);

/// A line for each backend of whose fragments and values some were not judged, and why not.
std::string not_judged_text(const std::vector<records::LawSummary>& rows);

/// A line for each backend of which drawings were made wrong on purpose, and how many were noticed.
std::string power_text(const std::vector<records::LawSummary>& rows);

/// A table of why laws that held on few cases or none did not judge the others, by backend and
/// reason; empty where there is none.
std::string not_checked_text(const std::vector<records::LawSummary>& rows);

/// How many laws held on few cases only, as a line; empty where none did.
std::string thin_text(const std::vector<records::LawSummary>& rows);

/// The table as one JSON document, without its end of line, and with each row's "precision" by kind
/// and stratum, for which a terminal has no room.
std::string summary_json(const records::Run& run, const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
