#pragma once

// A whole scene, such as a mesh, drawn once and every fragment of it judged.

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
  /// Under the laws on coverage and on values, in the stratum "scene NAME". Counterexamples are
  /// named like the stratum, and their index is a triangle's: the corpus may have that scene too.
  Findings findings;
  records::SceneResult result;  ///< named like the scene
  cases::Case source;           ///< of clip positions
  /// The nearest fragment of each pixel, for a picture; empty if no part could be drawn.
  std::optional<cases::Fragments> drawn;
  records::ErrorMap map;
};

/// Draws and judges the scene, part by part unless it has a depth test; `laws` names the laws that
/// are asked for. A scene of which the backend fails to draw a part violates them all; what is
/// `known` is counted as known. Judges in `jobs` threads. Fails where positions lie beyond float32.
Result<SceneFindings> judge_scene(const cases::Case& scene, const std::string& specification,
                                  backends::Backend& backend, std::uint64_t seed,
                                  const std::vector<std::string>& laws, unsigned jobs = 1,
                                  const KnownDefects* known = nullptr);

/// The same by parts of that size.
Result<SceneFindings> judge_scene_in(const PartLimits& limits, const cases::Case& scene,
                                     const std::string& specification, backends::Backend& backend,
                                     std::uint64_t seed, const std::vector<std::string>& laws,
                                     unsigned jobs = 1, const KnownDefects* known = nullptr);

}  // namespace rastercheck::properties
