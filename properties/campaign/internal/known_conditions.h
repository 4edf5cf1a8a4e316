#pragma once

// Whether a violation meets the conditions of a known defect.

#include "cases/case.h"
#include "records/counterexample.h"
#include "records/known.h"

namespace rastercheck::properties {

/// `clip` is a case without a camera. Measures are of doubles: they are thresholds of a list, not
/// verdicts. Of a violation without a place, or of a triangle that the case does not have, some
/// triangle of the case has to meet all that is asked of triangles.
bool meets(const records::KnownConditions& when, const cases::Case& clip,
           const records::Violation& violation);

}  // namespace rastercheck::properties
