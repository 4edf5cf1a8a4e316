#pragma once

#include <span>
#include <string>

#include "cases/error.h"
#include "records/run.h"

namespace rastercheck::reports {

/// Writes a run's folder (CONTRACT, output folder of a run), which is made where it is missing: a
/// case file for every counterexample, and the file of each format named (format.h).
///
/// A file is there whole or not at all: it is written under another name first. Case files in
/// counterexamples/ that an earlier run left, of laws and backends that this one checked, go to
/// counterexamples/earlier/, unless it was interrupted or a shard but the first; they are told by
/// the name that their `found` gives them, and nothing else is touched. Errors name the file, or
/// the format that there is not or that the run has too little for; what was written before an
/// error stays.
Result<void> write_reports(const records::Run& run, const std::string& directory,
                           std::span<const std::string> format_names);

}  // namespace rastercheck::reports
