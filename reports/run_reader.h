#pragma once

#include <string>
#include <string_view>

#include "cases/error.h"
#include "records/run.h"

namespace rastercheck::reports {

/// Parses a run.json (reports/formats/run_json.cpp). Writing the run again gives the same bytes.
/// Fails on unknown or missing keys, other versions, and values that the members cannot hold
/// exactly. `file` names the source in errors.
Result<records::Run> parse_run(std::string_view text, const std::string& file);

/// Reads a run from a file, or from standard input for "-".
Result<records::Run> read_run(const std::string& file);

/// Reads a run without its inspections, which are much of a file and rarely needed. Checks only
/// their syntax.
Result<records::Run> read_run_without_inspections(const std::string& file);

}  // namespace rastercheck::reports
