#pragma once

#include <optional>
#include <string>

#include "oracle/fragments.h"
#include "oracle/rational.h"

namespace rastercheck::oracle {

/// Formats a value as `rastercheck oracle --json` prints it: a fraction in quotes; ["lo", "hi"] if
/// the rules allow a range; null if undefined.
std::string to_json(const std::optional<ValueRange>& value);

/// Formats a fragment as one line of JSON: triangle, x, y, sample, verdict, reason, depth,
/// attributes.
std::string to_json(const Fragment& fragment);

/// Like to_json(), plus details: the signed distance to the deciding boundary as [lo, hi] in pixels
/// (null for a missing boundary or an infinite end), and for each attribute the screen derivatives
/// [∂r/∂u, ∂r/∂v] and the condition numbers kappa and kappa_d as fractions.
std::string to_detailed_json(const Fragment& fragment, const TriangleTruth& truth);

}  // namespace rastercheck::oracle
