#pragma once

#include "cases/error.h"
#include "properties/campaign/shard_merge.h"

namespace rastercheck::cli {

/// Inspects a run merged from shards, as `rastercheck run` does (properties/inspect/looks.h), by
/// drawing some cases once more. Fails if a backend cannot be made or promises something else here,
/// or if the corpus, scene or lists of known defects differ from the shards'.
Result<void> inspect_merged(properties::MergedRun& merged);

}  // namespace rastercheck::cli
