#pragma once

#include <string>

#include "cases/error.h"
#include "records/run.h"
#include "reports/compare_format.h"

namespace rastercheck::cli {

/// Under GitHub Actions (GITHUB_ACTIONS is "true") prints an annotation for each counterexample of
/// a run whose folder is `directory`; and appends summary.md to the file that GITHUB_STEP_SUMMARY
/// names, if it names one. The error is of that file.
Result<void> tell_github(const records::Run& run, const std::string& directory, bool prints);

/// The same of what a comparison with a baseline found: annotations, and compare.md.
Result<void> tell_github(const reports::Gate& gate, bool prints);

}  // namespace rastercheck::cli
