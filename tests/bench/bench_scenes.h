#pragma once

// Scenes to be timed: the same bits on every machine.

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

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

/// Numbers that look random (SplitMix64).
class Scatter {
 public:
  explicit Scatter(std::uint64_t seed) : state_(seed) {}
  /// In [0, 1), a multiple of 2^-24.
  float unit() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24F;
  }

 private:
  std::uint64_t state_;
};

/// A window position of the target as a clip position of that w.
inline glm::vec4 clip_position(float u, float v, float depth, float w) {
  return {(2 * u / kTarget - 1) * w, (2 * v / kTarget - 1) * w, depth * w, w};
}

inline void add_triangle(Scene& scene, const glm::vec4& a, const glm::vec4& b, const glm::vec4& c,
                         Scatter& scatter) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec4& p : {a, b, c}) {
    scene.positions.push_back(p);
    scene.attributes.push_back(scatter.unit());
    scene.attributes.push_back(scatter.unit());
  }
  scene.triangles.emplace_back(first, first + 1, first + 2);
}

/// `count` right triangles with legs of `side` pixels, anywhere, w in [1/2, 2).
inline Scene random_triangles(int count, float side) {
  Scene scene;
  Scatter scatter(1);
  for (int i = 0; i < count; ++i) {
    const float u = scatter.unit() * (kTarget - side);
    const float v = scatter.unit() * (kTarget - side);
    const float depth = scatter.unit();
    const float w = 0.5F + 1.5F * scatter.unit();
    add_triangle(scene, clip_position(u, v, depth, w), clip_position(u + side, v, depth, 1),
                 clip_position(u, v + side, depth, 1), scatter);
  }
  return scene;
}

/// The same with vertices on pixel centres and diagonals through centres: every edge meets samples.
inline Scene grid_triangles(int count, int side) {
  Scene scene;
  Scatter scatter(1);
  for (int i = 0; i < count; ++i) {
    const float u =
        0.5F +
        static_cast<float>(static_cast<int>(scatter.unit() * static_cast<float>(kTarget - side)));
    const float v =
        0.5F +
        static_cast<float>(static_cast<int>(scatter.unit() * static_cast<float>(kTarget - side)));
    const auto far = static_cast<float>(side);
    const float depth = scatter.unit();
    add_triangle(scene, clip_position(u, v, depth, 1), clip_position(u + far, v, depth, 1),
                 clip_position(u, v + far, depth, 1), scatter);
  }
  return scene;
}

/// Full-target triangles, in perspective.
inline Scene full_triangles(int count) {
  Scene scene;
  Scatter scatter(1);
  constexpr float kFar = 2 * kTarget;
  for (int i = 0; i < count; ++i) {
    const float depth = scatter.unit();
    add_triangle(scene, clip_position(0, 0, depth, 1), clip_position(kFar, 0, depth, 2),
                 clip_position(0, kFar, depth, 1.5F), scatter);
  }
  return scene;
}

}  // namespace rastercheck::bench
