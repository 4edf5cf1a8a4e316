#pragma once

#include <optional>
#include <string>

#include "oracle/fragments.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// Compares a fragment with the referee (oracle/referee.h), which computes it another way. Returns
/// one line describing the difference, which is a fault of the oracle itself. Returns nullopt if
/// the two agree, or if the referee does not apply (snapped coverage, a tie rule other than the
/// case's, an open verdict).
std::optional<std::string> self_check(const SceneTruth& scene, const Fragment& fragment);

/// Like above, for a sample of a triangle drawn alone, covered or not. The scene's contract must be
/// exact, with the case's own tie rule. Returns nullopt for a sample outside the framebuffer.
std::optional<std::string> self_check(const SceneTruth& scene, std::size_t triangle, int x, int y,
                                      int sample);

}  // namespace rastercheck::oracle
