#pragma once

// Serves the route “fragments” (docs/rasterizer.md, Routes).
//
// Draws lists of fragments, and traces one sample. The stages, for each triangle, are:
//
//   edges        lines and their error bounds in double (edge_functions.h, grid_piece.h, weights.h)
//   certificate  whether double suffices for the triangle's values (certificates.h)
//   coverage     the covered samples of a block of 64 pixels: those that exact arithmetic covers
//                (exact_coverage.h), or those that the snapped triangle covers (grid_coverage.h)
//   weights      E_i of the block's samples (block_kernels.h)
//   evaluation   depth and attributes from the weights, one rounding each (block_kernels.h,
//                exact_values.h), or in float32 on request (float_kernels.h); also on request,
//                their screen derivatives (derivatives.h)
//
// Every stage also shows its results to a Tap (tap.h).

#include <optional>

#include "rasterizer/internal/draw_setting.h"
#include "rasterizer/rasterizer.h"
#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

/// Appends the fragments of every triangle, as if each triangle were drawn alone. The arguments
/// must have been checked.
DrawCounts draw_mesh(const State& state, const Mesh& mesh, const TargetSize& size,
                     Fragments& fragments);

/// Traces a sample, as if its triangle were drawn alone; empty if the triangle is not set up. The
/// arguments must have been checked.
std::optional<Trace> trace_mesh(const State& state, const Mesh& mesh, const TargetSize& size,
                                const SamplePlace& address);

}  // namespace rastercheck::rasterizer
