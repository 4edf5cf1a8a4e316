#pragma once

#include "backends/factory.h"
#include "properties/inspect/run_cases.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Draws cases of a run once more and adds what is seen of them: the samples that its report shows
/// (run_inspections.h) and what a baseline of it would keep (specimens.h).
void look_closely(records::Run& run, const CaseSources& sources,
                  const backends::BackendFactory& backends);

}  // namespace rastercheck::properties
