#pragma once

// The state of cases of lines and points.

#include "cases/case.h"
#include "properties/draw.h"

namespace rastercheck::properties {

/// A state without what applies to triangles alone: culling and depth bias. `is_on_grid`: as
/// StateRequest has it.
cases::Case random_primitive_state(Draw& draw, cases::Primitive primitive, bool is_on_grid);

/// Sets the mode, mostly the one that the case's rules have for its samples, and the width.
void set_line_mode(Draw& draw, cases::Case& c);

void set_point_size(Draw& draw, cases::Case& c);

}  // namespace rastercheck::properties
