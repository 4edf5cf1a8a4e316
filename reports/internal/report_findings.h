#pragma once

#include <string>

#include "records/run.h"

namespace rastercheck::reports {

/// The findings to look at: each counterexample and each worst case. Findings that were inspected
/// include the viewer's data (internal/inspection_data.h). Empty if there are no findings.
std::string findings_of(const records::Run& run);

}  // namespace rastercheck::reports
