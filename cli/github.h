#pragma once

#include <string>

#include "cases/error.h"
#include "records/run.h"

namespace rastercheck::cli {

/// Under GitHub Actions (GITHUB_ACTIONS is "true") prints an annotation for each counterexample of
/// a run whose folder is `directory`; and appends summary.md to the file that GITHUB_STEP_SUMMARY
/// names, if it names one. The error is of that file.
Result<void> tell_github(const records::Run& run, const std::string& directory, bool prints);

}  // namespace rastercheck::cli
