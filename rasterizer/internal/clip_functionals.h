#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Clipping without a clipper (RULES §1). A clip plane with the distances g_i at the vertices is one
// more affine functional of the window,
//
//   G = g_0 E_0 + g_1 E_1 + g_2 E_2,
//
// and keeps the samples with G >= 0. No edge is cut, so no new vertex has to be rounded.

#include <array>
#include <vector>

#include "rasterizer/internal/edge_functions.h"

namespace rastercheck::rasterizer {

struct ClipFunctional {
  std::array<Coefficient, 3> g;
  /// True if samples with G = 0 are inside; if false, the normal of G decides, as with edges.
  bool is_closed = true;
};

/// The clip planes that may cut a triangle.
struct ClipFunctionals {
  std::vector<ClipFunctional> all;
  bool hides_all = false;  ///< true if all vertices are beyond the same plane
};

/// Collects the depth planes, unless the state clamps depth, and then the user clip planes.
/// distances[i] holds the distances of vertex i.
void clip_functionals(const State& state, const std::array<glm::vec4, 3>& corners,
                      const std::array<std::span<const float>, 3>& distances, ClipFunctionals& out);

/// True if G keeps the sample at (u, v); `e` holds the edges' values there. Decided in double if
/// double is certain, else exactly.
bool is_kept(const ClipFunctional& functional, const EdgeFunctions& edges,
             const std::array<double, 3>& e, const SampleFrame& frame, double u, double v,
             int tie_sign);

}  // namespace rastercheck::rasterizer
