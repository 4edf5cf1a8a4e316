#pragma once

// Cases for laws about pictures: triangles over triangles, in few pixels.

#include "properties/law.h"

namespace rastercheck::properties {

/// At most 32×32 pixels of one sample, fewer of several; most cases have four attributes, of
/// colours in and beyond [0, 1], and depths that are often equal.
Generated overlapping_case(Draw& draw);

/// Whether a backend promises what laws about pictures are about (Law::is_promised).
bool draws_pictures(backends::Backend& backend);

}  // namespace rastercheck::properties
