#pragma once

// Scenes to be timed: the same bits on every machine and in every process.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::bench {

/// Width and height of a target that says nothing else, in pixels.
inline constexpr int kTarget = 1024;

/// A mesh with its memory, two attributes in 0…1, and the size of its target.
struct Scene {
  glm::ivec2 size{kTarget, kTarget};
  std::vector<glm::vec4> positions;
  std::vector<float> attributes;
  std::vector<glm::uvec3> triangles;

  rasterizer::Mesh mesh() const { return {positions, attributes, {}, triangles}; }
};

/// `count` right triangles with legs of `side` pixels, anywhere, w in [1/2, 2).
Scene random_triangles(int count, float side, const glm::ivec2& size = {kTarget, kTarget});

/// The same with vertices on pixel centres and diagonals through centres: every edge meets samples.
Scene grid_triangles(int count, int side);

/// `count` squares of `side` × `side` whole pixels, anywhere, w = 1, each two triangles that share
/// the diagonal.
Scene sprites(int count, int side);

/// Full-target triangles, in perspective, at random depths.
Scene full_triangles(int count);

/// The same from back to front: under a depth test every fragment is the nearest so far.
Scene layers_back_to_front(int count, const glm::ivec2& size = {kTarget, kTarget});

/// The area of all triangles in the target, in pixels, hidden or not: how many fragments there are,
/// but for what edges round.
double drawn_area(const Scene& scene);

}  // namespace rastercheck::bench
