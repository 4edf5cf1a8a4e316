#pragma once

#include "backends/factory.h"
#include "properties/inspect/run_cases.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Draws cases of a run again and adds inspections for the report (run_inspections.h) and the parts
/// that a baseline would keep (specimens.h).
void look_closely(records::Run& run, const CaseSources& sources,
                  const backends::BackendFactory& backends);

}  // namespace rastercheck::properties
