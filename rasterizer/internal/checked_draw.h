#pragma once

// What every way of drawing fragments, and of tracing one, has in common: its arguments are checked
// first, and where memory runs out the fragments are those of before.

#include <functional>
#include <optional>

#include "rasterizer/rasterizer.h"
#include "rasterizer/trace.h"

namespace rastercheck::rasterizer {

std::optional<Error> check_size(const TargetSize& size);
std::optional<Error> check_state(const State& state);
/// `state` was checked.
std::optional<Error> check_mesh(const State& state, const Mesh& mesh);

/// All three.
std::optional<Error> check_draw(const State& state, const Mesh& mesh, const TargetSize& size);

/// What draws, as DrawFragments does.
using DrawCall = std::function<DrawCounts(const State& state, const Mesh& mesh,
                                          const TargetSize& size, Fragments& fragments)>;

/// Checks the arguments, then draws; Error::out_of_memory, with `fragments` as before, where an
/// allocation failed.
DrawResult draw_checked(const DrawCall& draw, const State& state, const Mesh& mesh,
                        const TargetSize& size, Fragments& fragments);

/// What traces a sample of a triangle of the mesh.
using TraceCall = std::function<std::optional<Trace>(
    const State& state, const Mesh& mesh, const TargetSize& size, const SamplePlace& address)>;

/// Checks the arguments, then traces; nothing where the sample is not of the target.
TraceResult trace_checked(const TraceCall& trace, const State& state, const Mesh& mesh,
                          const TargetSize& size, const SamplePlace& address);

}  // namespace rastercheck::rasterizer
