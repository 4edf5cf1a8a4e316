#pragma once

// Translates the rasterizer's lists of fragments into cases::Fragments.

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::backends {

/// Returns the fragments of a drawn case after the case's depth test, or the reason why the draw
/// was refused.
Result<cases::Fragments> drawn_fragments(const cases::Case& c, const rasterizer::DrawResult& drawn,
                                         const rasterizer::Fragments& fragments);

}  // namespace rastercheck::backends
