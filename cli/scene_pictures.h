#pragma once

#include "cases/case.h"
#include "cases/error.h"
#include "properties/findings.h"
#include "records/run.h"

namespace rastercheck::cli {

/// Judges the scene with each of the run's backends, in `jobs` threads, and adds what was drawn and
/// its error map to the run's pictures.
Result<properties::Findings> judge_scenes(const cases::Case& scene, unsigned jobs,
                                          records::Run& run);

}  // namespace rastercheck::cli
