#pragma once

// The table of a run, for people and for programs.

#include <span>
#include <string>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::cli {

/// One row per law and backend; errors in scale ULP.
std::string summary_table(std::span<const records::LawSummary> rows, bool quiet);

/// The same as one JSON document, without its end of line, and with each row's "precision" by kind
/// and stratum, for which a terminal has no room.
std::string summary_json(const records::Run& run, std::span<const records::LawSummary> rows);

}  // namespace rastercheck::cli
