#pragma once

// Scenes to be timed: the same bits on every machine and in every process.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::bench {

/// Width and height of the targets, in pixels.
inline constexpr int kTarget = 1024;

/// A mesh with its memory, two attributes.
struct Scene {
  std::vector<glm::vec4> positions;
  std::vector<float> attributes;
  std::vector<glm::uvec3> triangles;

  rasterizer::Mesh mesh() const { return {positions, attributes, {}, triangles}; }
};

/// `count` right triangles with legs of `side` pixels, anywhere, w in [1/2, 2).
Scene random_triangles(int count, float side);

/// The same with vertices on pixel centres and diagonals through centres: every edge meets samples.
Scene grid_triangles(int count, int side);

/// Full-target triangles, in perspective, at random depths.
Scene full_triangles(int count);

/// The same from back to front: under a depth test every fragment is the nearest so far.
Scene layers_back_to_front(int count);

/// The names of the scenes whose whole frames are timed.
const std::vector<std::string_view>& frame_scenes();

/// The scene of that name. Fails where there is none, or its mesh cannot be read.
Result<Scene> frame_scene(std::string_view name);

/// The area of all triangles in pixels, hidden or not: how many fragments there are, but for what
/// edges round. Holds for triangles in front of the eye that lie in the target or cover it all.
double drawn_area(const Scene& scene);

}  // namespace rastercheck::bench
