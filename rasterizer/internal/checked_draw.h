#pragma once

// What every way of drawing fragments has in common: its arguments are checked first, and where
// memory runs out the fragments are those of before.

#include <optional>

#include "rasterizer/methods/method.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

std::optional<Error> check_size(const TargetSize& size);
std::optional<Error> check_state(const State& state);
/// `state` was checked.
std::optional<Error> check_mesh(const State& state, const Mesh& mesh);

/// All three.
std::optional<Error> check_draw(const State& state, const Mesh& mesh, const TargetSize& size);

/// Checks the arguments, then draws; Error::out_of_memory, with `fragments` as before, where an
/// allocation failed.
DrawResult draw_checked(DrawFragments draw, const State& state, const Mesh& mesh,
                        const TargetSize& size, Fragments& fragments);

}  // namespace rastercheck::rasterizer
