#pragma once

#include <string>

#include "records/run.h"

namespace rastercheck::reports {

/// Describes, for a terminal, on how many of the same cases each of two backends was right, and
/// where they differ; empty for a run of one backend or a shard. `folder` is the run's folder.
std::string side_by_side_text(const records::Run& run, const std::string& folder);

}  // namespace rastercheck::reports
