#pragma once

// The scene of `rastercheck run --scene`: one mesh or case, drawn and judged as a whole.

#include <string>
#include <vector>

#include "backends/factory.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/findings.h"
#include "properties/campaign/known_defects.h"
#include "records/run.h"

namespace rastercheck::cli {

/// Returns the clip-space case of the plan's mesh or case file ("-": a case on standard input),
/// named after its file if it has no name. The case has a depth test if the plan draws a frame.
/// Prints a note to standard error if a mesh is seen by a camera of its file.
Result<cases::Case> read_scene(const records::Plan& plan);

/// A scene as drawn by all of a plan's backends.
struct JudgedScene {
  properties::Findings findings;
  std::vector<records::SceneResult> results;  ///< one per backend
  std::vector<records::Picture> pictures;     ///< the drawings, and their errors
};

/// Judges the scene with each of the plan's backends, in `jobs` threads. Counts defects in `known`
/// as known.
Result<JudgedScene> judge_scene_of(const records::Plan& plan, const cases::Case& scene,
                                   const backends::BackendFactory& backends, unsigned jobs,
                                   const properties::KnownByBackend& known);

}  // namespace rastercheck::cli
