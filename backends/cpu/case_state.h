#pragma once

// A case in the rasterizer's words.

#include "cases/case.h"
#include "cases/error.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::backends {

rasterizer::Convention convention(cases::Rules rules);

/// The grid that the rasterizer snaps to where a case asks for one.
int subpixel_bits(const cases::Snapping& snapping);

/// All but the depth test.
rasterizer::State state_of(const cases::Case& c, rasterizer::Precision precision);

rasterizer::TargetSize target_size(const cases::Case& c);

/// What the rasterizer says of a draw that it refused.
Error refused(rasterizer::Error error);

}  // namespace rastercheck::backends
