#pragma once

// Decides whether a violation meets the conditions of a known defect.

#include "cases/case.h"
#include "records/counterexample.h"
#include "records/known.h"

namespace rastercheck::properties {

/// Returns true if a violation of `clip`, a case without a camera, meets all conditions. Measures
/// are computed in double, because they are only compared with a list's thresholds and decide no
/// verdict. If the violation has no place, or names a triangle that the case lacks, one triangle of
/// the case must meet all conditions on triangles.
bool meets(const records::KnownConditions& when, const cases::Case& clip,
           const records::Violation& violation);

}  // namespace rastercheck::properties
