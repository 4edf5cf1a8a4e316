#pragma once

// Inspects a run's counterexamples and its largest errors.

#include <vector>

#include "properties/inspect/run_cases.h"
#include "records/inspection.h"
#include "records/run.h"

namespace rastercheck::properties {

/// Inspects the run's counterexamples in order, each at its first violation. Then inspects, for
/// every backend, kind and stratum, the largest ideal error (oracle/judge.h) over all laws, ordered
/// by (law, backend, kind, stratum). Returns at most records::kMostInspections; if these errors are
/// too many, leaves out the smaller ones. Also leaves out what cannot be shown: failed drawings,
/// drawings that the backend no longer reproduces, and errors from a law's changed version of the
/// case.
std::vector<records::Inspection> inspect_run(const records::Run& run, const CaseSources& sources,
                                             CaseDrawer& drawer);

}  // namespace rastercheck::properties
