#pragma once

// Cases of the corpus made for who is judged: the same picture by other rules, with other samples,
// and without what the case is not about.

#include "cases/capabilities.h"
#include "cases/case.h"

namespace rastercheck::properties {

/// Changes a case by its `essential` members so that a backend draws it. Rules change exactly: the
/// new clip positions are float32, and every sample that a triangle covers by the old rules it
/// covers by the new ones, with the same values and the same depth where clamping to the depth
/// range does not change it. Where that cannot be, or what the case is about is lacking, it is
/// given back as it is.
cases::Case fitted_case(const cases::Capabilities& capabilities, const cases::Case& c);

}  // namespace rastercheck::properties
