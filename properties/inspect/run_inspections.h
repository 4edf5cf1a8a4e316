#pragma once

// What of a run is looked at closely: its counterexamples, and where its values were the farthest
// off.

#include <vector>

#include "backends/factory.h"
#include "properties/inspect/run_cases.h"
#include "records/inspection.h"
#include "records/run.h"

namespace rastercheck::properties {

/// The run's counterexamples in their order, each at its first violation, and then, of every
/// backend, kind of value and stratum, the largest ideal error (oracle/judge.h) of all laws, by
/// (law, backend, kind, stratum); records::kMostInspections at most, of worst cases those that are
/// the farthest off. Left out is what cannot be shown: drawings that there are not, what its
/// backend no longer draws so, and errors of drawings that a law made of the case.
std::vector<records::Inspection> inspect_run(const records::Run& run, const CaseSources& sources,
                                             const backends::BackendFactory& backends);

}  // namespace rastercheck::properties
