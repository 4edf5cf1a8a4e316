#pragma once

// Finds out whether a wrong drawing is the right drawing of a simply changed case: "this is the
// exact picture, but y points in the other direction".

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "backends/backend.h"
#include "cases/case.h"
#include "properties/campaign/internal/put_right.h"
#include "properties/campaign/shrink.h"

namespace rastercheck::properties {

/// Draws a case and returns, as clauses, the simple changes of the case after which the same
/// drawing would be right, the commonest first, each once. Judges the given parts alone, as other
/// parts may be wrong for another reason, and also the whole drawing. A change counts only if the
/// right drawing of the unchanged case is wrong for the changed case: otherwise the change proves
/// nothing. Returns an empty optional if the given parts are drawn right or the case cannot be
/// drawn; returns what was found so far if `is_to_end` returns true.
std::optional<std::vector<std::string>> hints_of(const cases::Case& source,
                                                 backends::Backend& backend,
                                                 const DrawnParts& parts, const IsToEnd& is_to_end);

}  // namespace rastercheck::properties
