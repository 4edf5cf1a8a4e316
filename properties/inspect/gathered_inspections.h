#pragma once

// Combines the shards' inspections into those of the whole run, on a machine without their
// backends.

#include <span>
#include <vector>

#include "properties/campaign/shard_merge.h"
#include "records/inspection.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Returns inspections in the order and with the limit of inspect_run(). Takes each
/// counterexample's inspection from the shard that found it. For each backend, kind and stratum,
/// takes the largest error that any shard showed, which may differ from the largest error that can
/// be shown for the whole run.
std::vector<records::Inspection> gathered_inspections(const records::Run& run,
                                                      std::span<const MergedRun::LookedAt> shards);

}  // namespace rastercheck::properties
