#pragma once

// Cases whose triangles fill an outline that holds the whole viewport.

#include "properties/law.h"

namespace rastercheck::properties {

/// A jittered grid with a diagonal of each cell, the same with all vertices on samples, or points
/// inserted one after the other into triangles and edges; no culling and no depth test. Vertices
/// are shared, their w positive. Of some all are cut by one plane: z, or a clip distance, is ±x or
/// ±y at every vertex. Rounding may turn thin triangles round: not every case is what it should be.
Generated triangulated_screen(Draw& draw);

}  // namespace rastercheck::properties
