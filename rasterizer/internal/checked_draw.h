#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Wraps every way of drawing fragments or tracing a sample: checks the arguments first and, if
// memory runs out, leaves the fragments unchanged.

#include <functional>
#include <optional>

#include "rasterizer/rasterizer.h"
#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

std::optional<Error> check_size(const TargetSize& size);
std::optional<Error> check_state(const State& state);
/// `state` must have been checked.
std::optional<Error> check_mesh(const State& state, const Mesh& mesh);

/// Checks size, state and mesh.
std::optional<Error> check_draw(const State& state, const Mesh& mesh, const TargetSize& size);

/// A function that draws as DrawFragments (methods/method.h) does, but without a tap.
using DrawCall = std::function<DrawCounts(const State& state, const Mesh& mesh,
                                          const TargetSize& size, Fragments& fragments)>;

/// Checks the arguments, then draws. Returns Error::out_of_memory, with `fragments` unchanged, if
/// an allocation failed.
DrawResult draw_checked(const DrawCall& draw, const State& state, const Mesh& mesh,
                        const TargetSize& size, Fragments& fragments);

/// A function that traces a sample of a triangle of the mesh.
using TraceCall = std::function<std::optional<Trace>(
    const State& state, const Mesh& mesh, const TargetSize& size, const SamplePlace& address)>;

/// Checks the arguments, then traces. The trace is empty if the sample lies outside the target.
TraceResult trace_checked(const TraceCall& trace, const State& state, const Mesh& mesh,
                          const TargetSize& size, const SamplePlace& address);

}  // namespace rastercheck::rasterizer
