#pragma once

#include <string>

#include "records/run.h"

namespace rastercheck::reports {

/// What was found, to be looked at: each counterexample, each worst case. Those that were inspected
/// have the data of the viewer with them (internal/inspection_data.h). Empty where there are none.
std::string findings_of(const records::Run& run);

}  // namespace rastercheck::reports
