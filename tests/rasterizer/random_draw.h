#pragma once

// Random draws of every kind: triangles on a grid, ordinary ones, slivers, some through the eye,
// numbers of all sizes; viewports from plain to absurd.

#include "tests/rasterizer/exact.h"
#include "tests/rasterizer/small_draw.h"

namespace rastercheck::rasterizer {

struct RandomDraw {
  State state;
  SmallMesh mesh;
  TargetSize size;
};

enum class ViewportKind { plain, on_a_grid, tenths, subnormal, narrow, enormous, mirrored, any };

/// A viewport that shares something with a target of this size, most of the time.
Viewport random_viewport(Random& random, ViewportKind kind, const TargetSize& size);

/// A triangle with three attributes and the state's clip distances.
SmallMesh random_mesh(Random& random, const State& state);

/// All of a draw.
RandomDraw random_draw(Random& random);

}  // namespace rastercheck::rasterizer
