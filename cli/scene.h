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

/// The clip case of the plan's mesh or case file, "-" for a case on standard input, under the name
/// of its file if it has no other. Drawn as a frame it has a depth test.
Result<cases::Case> read_scene(const records::Plan& plan);

/// A scene as all of a plan's backends drew it.
struct JudgedScene {
  properties::Findings findings;
  std::vector<records::SceneResult> results;  ///< backend by backend
  std::vector<records::Picture> pictures;     ///< what was drawn, and its errors
};

/// Judges the scene with each of the plan's backends, in `jobs` threads. What is `known` of a
/// backend is counted as known.
Result<JudgedScene> judge_scene_of(const records::Plan& plan, const cases::Case& scene,
                                   const backends::BackendFactory& backends, unsigned jobs,
                                   const properties::KnownByBackend& known);

}  // namespace rastercheck::cli
