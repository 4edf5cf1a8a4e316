#pragma once

// What `rastercheck run --scene` is about: one mesh or case, drawn and judged whole.

#include <string>
#include <vector>

#include "backends/factory.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/findings.h"
#include "properties/campaign/known_defects.h"
#include "records/run.h"

namespace rastercheck::cli {

/// The clip case of a mesh or case file, "-" for a case on standard input, under the name of its
/// file if it has no other. A mesh's picture has `size` · `size` pixels.
Result<cases::Case> read_scene(const std::string& file, int size);

/// Judges the scene with each of the plan's backends, in `jobs` threads, and adds what was drawn
/// and its error map to the pictures. What is `known` of a backend is counted as known.
Result<properties::Findings> judge_scene_of(const records::Plan& plan, const cases::Case& scene,
                                            const backends::BackendFactory& backends, unsigned jobs,
                                            const properties::KnownByBackend& known,
                                            std::vector<records::Picture>& pictures);

}  // namespace rastercheck::cli
