#pragma once

// Inspects the run that shards were merged into.

#include <functional>

#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/plan_run.h"
#include "properties/campaign/shard_merge.h"
#include "records/plan.h"

namespace rastercheck::properties {

/// Reads a plan's scene, without a camera.
using SceneReader = std::function<Result<cases::Case>(const records::Plan&)>;

/// Inspects a merged run as a run in one process is inspected (looks.h). Fails if a backend cannot
/// be made or promises something else here, or if the corpus, the scene or the lists of known
/// defects differ from the shards'; the shards' own inspections can be gathered instead
/// (gathered_inspections.h). Uses the conduct's corpus, known defects and backends.
Result<void> inspect_merged(MergedRun& merged, const Conduct& conduct,
                            const SceneReader& read_scene);

}  // namespace rastercheck::properties
