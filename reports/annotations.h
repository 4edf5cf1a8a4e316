#pragma once

#include <string>

#include "records/run.h"

namespace rastercheck::reports {

/// What GitHub Actions shows beside a commit, a workflow command a line: an error for each
/// counterexample, its file within `directory`, and each label that was not reached; a warning for
/// each unexpected pass of another version of a driver. Empty where there is none.
std::string github_annotations(const records::Run& run, const std::string& directory);

}  // namespace rastercheck::reports
