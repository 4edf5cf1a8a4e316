#pragma once

#include <string>

#include "records/run.h"
#include "reports/compare_format.h"

namespace rastercheck::reports {

/// What GitHub Actions shows beside a commit, a workflow command a line: an error for each
/// counterexample, its file within `directory`, and each label that was not reached; a warning for
/// each unexpected pass of another version of a driver. Empty where there is none.
std::string github_annotations(const records::Run& run, const std::string& directory);

/// The same of a comparison with a baseline: an error for each entry that is worse and not allowed,
/// the first of them, and a warning for each line of the policy that is to be looked at.
std::string github_annotations(const Gate& gate);

}  // namespace rastercheck::reports
