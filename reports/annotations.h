#pragma once

#include <string>

#include "records/run.h"
#include "reports/compare_format.h"

namespace rastercheck::reports {

/// The annotations that GitHub Actions shows beside a commit, one workflow command per line: an
/// error for each counterexample (its file is within `directory`) and for each label that was not
/// reached; a warning for each unexpected pass under another version of a driver. Empty if there
/// are none.
std::string github_annotations(const records::Run& run, const std::string& directory);

/// Annotations for a comparison with a baseline: an error for each worse entry that is not allowed
/// (only for the first ones), and a warning for each line of the policy that needs attention.
std::string github_annotations(const Gate& gate);

}  // namespace rastercheck::reports
