#pragma once

// The rasterizer's lists of fragments in the words of cases.

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::backends {

/// What a draw of a case made, by the case's depth test; or why it was refused.
Result<cases::Fragments> drawn_fragments(const cases::Case& c, const rasterizer::DrawResult& drawn,
                                         const rasterizer::Fragments& fragments);

}  // namespace rastercheck::backends
