#pragma once

#include "cases/error.h"
#include "properties/campaign/shard_merge.h"

namespace rastercheck::cli {

/// Looks closely at the run that shards were put together to, as `rastercheck run` does: draws what
/// it shows, and what it keeps of its drawings, once more. Fails, saying why, where that cannot be:
/// a backend cannot be made or promises something else here, or corpus, scene or lists of known
/// defects are not what the shards had.
Result<void> inspect_merged(properties::MergedRun& merged);

}  // namespace rastercheck::cli
