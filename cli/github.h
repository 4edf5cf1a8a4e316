#pragma once

#include <string>

#include "cases/error.h"
#include "records/run.h"
#include "reports/compare_format.h"

namespace rastercheck::cli {

/// Under GitHub Actions (GITHUB_ACTIONS is "true"), prints an annotation for each counterexample of
/// a run whose folder is `directory`. Appends summary.md to the file named by GITHUB_STEP_SUMMARY,
/// if any. Fails if that file cannot be written.
Result<void> tell_github(const records::Run& run, const std::string& directory, bool prints);

/// Like the above for a comparison with a baseline: annotations, and compare.md.
Result<void> tell_github(const reports::Gate& gate, bool prints);

}  // namespace rastercheck::cli
