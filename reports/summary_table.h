#pragma once

// Tables and lines that summarise a run, for people and for programs.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::reports {

/// A table with one row per law and backend, and errors in scale ULP. If `quiet`, the table has no
/// header and is never narrowed; otherwise text_table() fits it into `columns`.
std::string summary_table(const std::vector<records::LawSummary>& rows, bool quiet,
                          std::optional<std::size_t> columns);

/// Returns the rows that need a look: laws that are violated, violated only by known defects, or
/// held on too few cases (thin).
std::vector<records::LawSummary> notable_rows(const std::vector<records::LawSummary>& rows);

/// One line per backend with the number of laws by verdict and the number of causes, the worst
/// first: "cpu: 3 laws violated in 2 causes, 40 held." If `has_color`, with escape sequences of
/// terminals: red for violated laws, yellow for what needs a look, green for laws that held.
std::string verdict_lines(const records::Run& run, const std::vector<records::LawSummary>& rows,
                          bool has_color);

/// Lines with the counts of samples by verdict, and with the share of all answers that each level
/// of the oracle gave.
std::string summary_counts(const std::vector<records::LawSummary>& rows);

/// The number of cases in which each known defect was seen, one line per backend; empty if none was
/// seen.
std::string known_text(const records::Run& run);

/// One line per backend that left fragments or values unjudged, with the reasons.
std::string not_judged_text(const std::vector<records::LawSummary>& rows);

/// One line per backend whose drawings were made wrong on purpose, with the number of wrong
/// drawings that were noticed.
std::string power_text(const std::vector<records::LawSummary>& rows);

/// A table of laws that held on few or no cases, by backend and by the reason why they did not
/// judge the other cases; empty if there are none.
std::string not_checked_text(const std::vector<records::LawSummary>& rows);

/// A line with the number of laws that held on only a few cases; empty if there are none.
std::string thin_text(const std::vector<records::LawSummary>& rows);

/// The table as one JSON document, without a final newline. Each row also has its "precision" by
/// kind and stratum, for which a terminal has no room.
std::string summary_json(const records::Run& run, const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
