#pragma once

#include <optional>
#include <string>

#include "oracle/fragments.h"
#include "oracle/triangle_truth.h"

namespace rastercheck::oracle {

/// Holds a fragment against the referee (oracle/referee.h), which computes it another way. Nothing
/// where they agree, or where the referee does not apply (snapped coverage, an open verdict);
/// otherwise one line that says what differs: a fault of the oracle itself.
std::optional<std::string> self_check(const SceneTruth& scene, const Fragment& fragment);

/// The same of a sample of a triangle drawn alone, covered or not. The scene's contract is exact,
/// with the case's own tie rule; of a sample outside the framebuffer there is nothing to say.
std::optional<std::string> self_check(const SceneTruth& scene, std::size_t triangle, int x, int y,
                                      int sample);

}  // namespace rastercheck::oracle
