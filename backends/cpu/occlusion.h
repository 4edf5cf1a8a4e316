#pragma once

// Occlusion queries, answered by drawing.

#include <cstddef>
#include <functional>

#include "cases/case.h"
#include "cases/error.h"
#include "cases/fragments.h"

namespace rastercheck::backends {

/// Draws the fragments of a case.
using DrawFragments = std::function<Result<cases::Fragments>(const cases::Case&)>;

/// True if no fragment of the case's triangles from index `occluders` on is nearer than what the
/// triangles before them leave in the depth buffer.
Result<bool> is_hidden_in_depth_buffer(const cases::Case& c, std::size_t occluders,
                                       const DrawFragments& draw);

}  // namespace rastercheck::backends
