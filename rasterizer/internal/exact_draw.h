#pragma once

// The production rasterizer's drawing: the mathematical triangle of the float32 clip positions,
// sample by sample, and one rounding per value.
//
// Steps, for each triangle
//   1. sign det (x, y, w): nothing is drawn where it is 0; facing and culling (determinant.h)
//   2. edge functions in homogeneous coordinates, with their bands (edge_functions.h)
//   3. clip planes as functionals of the edges (clip_functionals.h)
//   4. certificates and coefficients of depth and attributes (exact_values.h)
//   5. blocks of 64 pixels of a row: edges in double on vectors (block_kernels.h); samples within a
//      band are decided by exact sums; values in double, or from exact sums where a certificate
//      fails
//
// Coverage is that of exact arithmetic for every finite input: no snapping, no clip vertices, w <=
// 0 is ordinary (seed 000, clipless homogeneous scan conversion; RULES §6).

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// The most that a depth or attribute is off, in scale ULP, derived in exact_values.h.
inline constexpr double kValueBound = 0.5 + 0x1p-7;

/// Appends the fragments of every triangle, as if each were drawn alone. The arguments were
/// checked.
DrawCounts draw_exact(const State& state, const Mesh& mesh, const TargetSize& size,
                      Fragments& fragments);

}  // namespace rastercheck::rasterizer
