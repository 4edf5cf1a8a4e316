#pragma once

// Draws a whole scene, such as a mesh, once and judges every fragment.

#include <optional>
#include <string>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/findings.h"
#include "properties/campaign/known_defects.h"
#include "properties/campaign/scene_parts.h"
#include "records/error_map.h"
#include "records/scene_result.h"

namespace rastercheck::properties {

struct SceneFindings {
  /// Findings of the laws on coverage and values, in the stratum "scene NAME". Counterexamples are
  /// named like the stratum, because the corpus may have a case with the scene's own name. Their
  /// index is the index of a triangle.
  Findings findings;
  records::SceneResult result;  ///< named like the scene
  cases::Case source;           ///< the scene in clip positions
  /// The nearest fragment of each pixel, for a picture; empty if no part could be drawn.
  std::optional<cases::Fragments> drawn;
  records::ErrorMap map;
};

/// Draws and judges the scene under the laws named by `laws`, part by part unless it has a depth
/// test. If the backend fails to draw a part, all these laws are violated. Violations that `known`
/// explains count as known. Judges in `jobs` threads. Fails if positions lie beyond float32.
Result<SceneFindings> judge_scene(const cases::Case& scene, const std::string& specification,
                                  backends::Backend& backend, std::uint64_t seed,
                                  const std::vector<std::string>& laws, unsigned jobs = 1,
                                  const KnownDefects* known = nullptr);

/// judge_scene() with parts of the given size.
Result<SceneFindings> judge_scene_in(const PartLimits& limits, const cases::Case& scene,
                                     const std::string& specification, backends::Backend& backend,
                                     std::uint64_t seed, const std::vector<std::string>& laws,
                                     unsigned jobs = 1, const KnownDefects* known = nullptr);

}  // namespace rastercheck::properties
