#pragma once

// Cases whose triangles fill an outline around the whole viewport.

#include "properties/law.h"

namespace rastercheck::properties {

/// A jittered grid with one diagonal per cell, a grid with all vertices on samples, or points
/// inserted one by one into triangles and edges. No culling and no depth test. Triangles share
/// vertices; every w is positive. In some cases one plane cuts all triangles: z, or a clip
/// distance, is ±x or ±y at every vertex. Rounding may flip thin triangles, so not every case is a
/// proper triangulation.
Generated triangulated_screen(Draw& draw);

}  // namespace rastercheck::properties
