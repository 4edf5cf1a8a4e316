#pragma once

#include <optional>
#include <string>

#include "oracle/fragments.h"
#include "oracle/rational.h"

namespace rastercheck::oracle {

/// A value as `rastercheck oracle --json` prints it: a fraction in quotes, ["lo", "hi"] where the
/// rules leave a range open, null where it is undefined.
std::string to_json(const std::optional<ValueRange>& value);

/// A fragment as one line of JSON: triangle, x, y, sample, verdict, reason, depth, attributes.
std::string to_json(const Fragment& fragment);

/// The same with what else is known of it: the signed distance to the deciding boundary as
/// [lo, hi] in pixels (null: none, or no bound), and per attribute the screen derivatives
/// [∂r/∂u, ∂r/∂v] and the condition numbers kappa and kappa_d as fractions.
std::string to_detailed_json(const Fragment& fragment, const TriangleTruth& truth);

}  // namespace rastercheck::oracle
