#pragma once

// Small draws for the tests: triangles given by their window positions, and pictures of what they
// cover.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A mesh that owns its data.
struct SmallMesh {
  std::vector<glm::vec4> positions;
  std::vector<float> attributes;
  std::vector<float> clip_distances;
  std::vector<glm::uvec3> triangles;

  Mesh mesh() const { return {positions, attributes, clip_distances, triangles}; }
};

/// A state with the viewport (0, 0, width, height), depths 0 and 1, and the fill rule of the
/// convention.
inline State small_state(int width, int height, Convention convention = Convention::vulkan) {
  State state;
  state.convention = convention;
  state.viewport.size = {width, height};
  state.fill_rule = convention == Convention::opengl ? FillRule::bottom_left : FillRule::top_left;
  return state;
}

/// The clip position with this w and depth z/w that small_state's viewport maps to the window
/// position (u, v). Exact for dyadic numbers of few digits if width and height are powers of two.
inline glm::vec4 at(const State& state, float u, float v, float w = 1, float depth = 0) {
  const glm::vec2 size = state.viewport.size;
  const float y = 2 * v / size.y - 1;
  return {(2 * u / size.x - 1) * w, (state.convention == Convention::d3d ? -y : y) * w, depth * w,
          w};
}

/// One triangle with these window positions and w = 1.
inline SmallMesh triangle(const State& state, glm::vec2 a, glm::vec2 b, glm::vec2 c) {
  SmallMesh mesh;
  mesh.positions = {at(state, a.x, a.y), at(state, b.x, b.y), at(state, c.x, c.y)};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// The rectangle with window corners `low` and `high` as two triangles, split along the diagonal
/// from `low` to `high` or, if `across`, along the other one.
inline SmallMesh rectangle(const State& state, glm::vec2 low, glm::vec2 high, bool across = false) {
  SmallMesh mesh;
  mesh.positions = {at(state, low.x, low.y), at(state, high.x, low.y), at(state, high.x, high.y),
                    at(state, low.x, high.y)};
  if (across) {
    mesh.triangles = {{0, 1, 3}, {1, 2, 3}};
  } else {
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  }
  return mesh;
}

inline Fragments fragments_of(const State& state, const SmallMesh& mesh, const TargetSize& size) {
  Fragments fragments;
  static_cast<void>(draw_fragments(state, mesh.mesh(), size, fragments));
  return fragments;
}

/// The number of times that each sample was drawn, [y][x][sample].
inline std::vector<int> times_drawn(const Fragments& fragments, const TargetSize& size) {
  const auto width = static_cast<std::size_t>(size.width);
  const auto samples = static_cast<std::size_t>(size.samples);
  std::vector<int> times(width * static_cast<std::size_t>(size.height) * samples);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    ++times[(fragments.y[i] * width + fragments.x[i]) * samples + fragments.sample[i]];
  }
  return times;
}

using Rows = std::vector<std::string>;

/// One string for each row, y = 0 first, with one letter for each sample: '.' if it was not drawn,
/// '#' if it was drawn once, otherwise the number of times.
inline Rows picture(const Fragments& fragments, const TargetSize& size) {
  const std::vector<int> times = times_drawn(fragments, size);
  const auto row_length =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.samples);
  Rows rows;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i % row_length == 0) rows.emplace_back();
    rows.back() += times[i] == 0 ? '.' : times[i] == 1 ? '#' : static_cast<char>('0' + times[i]);
  }
  return rows;
}

inline Rows picture(const State& state, const SmallMesh& mesh, const TargetSize& size) {
  return picture(fragments_of(state, mesh, size), size);
}

/// The value of the first attribute at a sample; NaN if it was not drawn.
inline float value_at(const Fragments& fragments, int x, int y, int sample = 0) {
  const std::size_t stride = fragments.attributes.size() / fragments.size();
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (fragments.x[i] == x && fragments.y[i] == y && fragments.sample[i] == sample) {
      return fragments.attributes[i * stride];
    }
  }
  return NAN;
}

/// Compares the first attribute of every fragment with a function of its pixel's centre, to
/// slightly more than half a unit of float32.
inline void expect_values(const Fragments& fragments,
                          const std::function<double(double, double)>& exact) {
  ASSERT_GT(fragments.size(), 0U);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const double expected = exact(fragments.x[i] + 0.5, fragments.y[i] + 0.5);
    EXPECT_NEAR(fragments.attributes[i], expected, 0x1.001p-24 * std::abs(expected))
        << fragments.x[i] << ", " << fragments.y[i];
  }
}

/// A rectangle over a target of 4 x 4 whose depth z/w is `level` plus `slope` times v − 1.5 or, if
/// not `along_v`, u − 1.5.
inline SmallMesh sloping(const State& state, bool along_v, float slope, float level) {
  SmallMesh mesh = rectangle(state, {0, 0}, {4, 4});
  const glm::vec2 corners[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.positions[i].z = level + slope * ((along_v ? corners[i].y : corners[i].x) - 1.5F);
  }
  return mesh;
}

}  // namespace rastercheck::rasterizer
