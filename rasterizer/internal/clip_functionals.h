#pragma once

// Clipping without a clipper (RULES §1): a clip plane whose distances at the vertices are g_i is
// one more affine functional of the window,
//
//   G = g_0 E_0 + g_1 E_1 + g_2 E_2,
//
// and keeps the samples with G >= 0. Nothing is cut, so no new vertex is rounded.

#include <array>
#include <vector>

#include "rasterizer/internal/edge_functions.h"

namespace rastercheck::rasterizer {

struct ClipFunctional {
  std::array<Coefficient, 3> g;
  /// G = 0 is inside; otherwise its normal decides, as an edge's does.
  bool is_closed = true;
};

/// The clip planes that may cut what the edges leave of a triangle.
struct ClipFunctionals {
  std::vector<ClipFunctional> all;
  bool hides_all = false;  ///< some plane has all vertices beyond it
};

/// Depth planes unless the state clamps depth, then the user distances: distances[i] are vertex
/// i's.
void clip_functionals(const State& state, const std::array<glm::vec4, 3>& corners,
                      const std::array<std::span<const float>, 3>& distances, ClipFunctionals& out);

/// Whether G keeps the sample at (u, v), whose edges evaluate to `e`: decided in double where that
/// is certain, else exactly.
bool is_kept(const ClipFunctional& functional, const EdgeFunctions& edges,
             const std::array<double, 3>& e, const SampleFrame& frame, double u, double v,
             int tie_sign);

}  // namespace rastercheck::rasterizer
