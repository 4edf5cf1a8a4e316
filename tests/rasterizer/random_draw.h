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

/// A viewport that usually overlaps a target of this size.
Viewport random_viewport(Random& random, ViewportKind kind, const TargetSize& size);

/// A triangle with values for the state's attributes and clip distances.
SmallMesh random_mesh(Random& random, const State& state);

/// A complete draw: target size, state and mesh.
RandomDraw random_draw(Random& random);

}  // namespace rastercheck::rasterizer
