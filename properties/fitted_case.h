#pragma once

// Adapts corpus cases to the judged backend by changing rules, sample count and framebuffer size
// and by leaving out inessential features.

#include "cases/capabilities.h"
#include "cases/case.h"

namespace rastercheck::properties {

/// Changes a case so that a backend can draw it, but keeps everything that `essential` names.
/// Changing rules is exact: the new clip positions are float32, and triangles cover the same
/// samples with the same values, and with the same depth unless depth clamping changes it. Returns
/// the case unchanged if this is impossible, or if the backend lacks an essential feature.
cases::Case fitted_case(const cases::Capabilities& capabilities, const cases::Case& c);

}  // namespace rastercheck::properties
