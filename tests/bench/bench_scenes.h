#pragma once

// Scenes for timing, with the same bits on every machine and in every process.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::bench {

/// The default width and height of a target, in pixels.
inline constexpr int kTarget = 1024;

/// A mesh with its memory, two attributes in 0…1, and the size of its target.
struct Scene {
  glm::ivec2 size{kTarget, kTarget};
  std::vector<glm::vec4> positions;
  std::vector<float> attributes;
  std::vector<glm::uvec3> triangles;

  rasterizer::Mesh mesh() const { return {positions, attributes, {}, triangles}; }
};

/// `count` right triangles with legs of `side` pixels, at random places, w in [1/2, 2).
Scene random_triangles(int count, float side, const glm::ivec2& size = {kTarget, kTarget});

/// Like random_triangles(), but vertices lie on pixel centres and diagonals pass through centres,
/// so that every edge meets samples.
Scene grid_triangles(int count, int side);

/// `count` squares of `side` × `side` whole pixels, at random places, w = 1. Each is made of two
/// triangles that share the diagonal.
Scene sprites(int count, int side);

/// Triangles that cover the whole target, in perspective, at random depths.
Scene full_triangles(int count);

/// Like full_triangles(), but from back to front, so that every fragment passes the depth test.
Scene layers_back_to_front(int count, const glm::ivec2& size = {kTarget, kTarget});

/// The total area of all triangles in the target, in pixels, whether hidden or not. This is the
/// number of fragments, except for rounding at edges.
double drawn_area(const Scene& scene);

}  // namespace rastercheck::bench
