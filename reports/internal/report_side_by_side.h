#pragma once

#include <string>

#include "records/run.h"

namespace rastercheck::reports {

/// The section of report.html that shows backends side by side; empty for a run of one backend or a
/// shard.
std::string side_by_side_section(const records::Run& run);

}  // namespace rastercheck::reports
