#pragma once

#include <span>
#include <string>

#include "cases/error.h"
#include "records/run.h"

namespace rastercheck::reports {

/// Writes a run's folder (docs/report.md), which is created if missing: a case file for every
/// counterexample and every difference of two backends, and a file for each named format
/// (format.h).
///
/// Each file is written either whole or not at all: first under another name, then renamed. Case
/// files that an earlier run left in counterexamples/ move to counterexamples/earlier/, and
/// likewise those in differences/. Exception: if this run was interrupted or is a shard other than
/// the first, counterexamples of its own laws and backends stay. A case file counts as left by a
/// run only if its name matches its own `found`; no other file is touched. Errors name the file, or
/// a format that does not exist or needs more than the run has. Files written before an error stay.
Result<void> write_reports(const records::Run& run, const std::string& directory,
                           std::span<const std::string> format_names);

}  // namespace rastercheck::reports
