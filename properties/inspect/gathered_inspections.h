#pragma once

// What shards looked at closely, as what the whole run does: for where their backends are not.

#include <span>
#include <vector>

#include "properties/campaign/shard_merge.h"
#include "records/inspection.h"
#include "records/run.h"

namespace rastercheck::properties {

/// As inspect_run() orders them, and as many. Of the run's counterexamples what the shard showed
/// that found them; of each backend, kind and stratum the largest error that any shard showed,
/// which may be another than the run's own largest that can be shown.
std::vector<records::Inspection> gathered_inspections(const records::Run& run,
                                                      std::span<const MergedRun::LookedAt> shards);

}  // namespace rastercheck::properties
