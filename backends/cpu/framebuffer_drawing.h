#pragma once

// Fragments of a case by way of the framebuffer that users draw into: each triangle alone in one,
// or all by the depth test of the case.

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends {

/// On that many threads. Values are those of framebuffers, in double; there are no derivatives.
Result<cases::Fragments> draw_through_framebuffer(const cases::Case& c, unsigned threads);

}  // namespace rastercheck::backends
