#pragma once

// Gets the fragments of a case from the framebuffer that users draw into. Each triangle is drawn
// into it alone, or all together if the case has a depth test.

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::backends {

/// Draws with this coverage, on `threads` threads. The values come from framebuffers, which hold
/// results of computations in double. The fragments have no derivatives.
Result<cases::Fragments> draw_through_framebuffer(const cases::Case& c,
                                                  rasterizer::Conservative conservative,
                                                  unsigned threads);

}  // namespace rastercheck::backends
