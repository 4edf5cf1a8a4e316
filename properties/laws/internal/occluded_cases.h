#pragma once

// Cases for properties about occlusion: the last triangle is asked about, the others may hide it.

#include "properties/law.h"

namespace rastercheck::properties {

/// A case of at most 32×32 pixels with one sample, or fewer pixels with several, without
/// attributes. Its last triangle is mostly behind the others: beyond a gap of a sample or less,
/// behind edges that meet, at an equal depth, partly outside of the viewport, or behind occluders
/// with vertices behind the eye or 2^27 pixels away.
Generated occluded_case(Draw& draw);

}  // namespace rastercheck::properties
