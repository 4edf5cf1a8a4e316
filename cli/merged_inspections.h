#pragma once

#include <vector>

#include "cases/error.h"
#include "properties/shard_merge.h"
#include "records/inspection.h"

namespace rastercheck::cli {

/// What the run that shards were put together to looks at closely, drawn here. Fails, saying why,
/// where that cannot be: a backend cannot be made or promises something else here, or corpus, scene
/// or lists of known defects are not what the shards had.
Result<std::vector<records::Inspection>> inspect_merged(const properties::MergedRun& merged);

}  // namespace rastercheck::cli
