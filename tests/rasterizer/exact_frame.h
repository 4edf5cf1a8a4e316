#pragma once

// Samples and edge functions in homogeneous coordinates, in rationals, for tests of the
// rasterizer's double arithmetic. Definitions: rasterizer/internal/sample_frame.h and
// edge_functions.h.

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/sample_frame.h"
#include "rasterizer/internal/standard_pattern.h"
#include "tests/rasterizer/exact.h"
#include "tests/rasterizer/random_draw.h"

namespace rastercheck::rasterizer {

using Corners = std::array<glm::vec4, 3>;

/// (U, V, T) of a window position, exactly.
inline std::array<Rational, 3> exact_position(const State& state, double u, double v) {
  const Rational x0 = state.viewport.origin.x;
  const Rational y0 = state.viewport.origin.y;
  const Rational width = state.viewport.size.x;
  const Rational height = state.viewport.size.y;
  const int turn = state.convention == Convention::d3d ? -1 : 1;
  return {Rational(sgn(width) * abs(height) * (2 * Rational(u) - 2 * x0 - width)),
          Rational(turn * sgn(height) * abs(width) * (2 * Rational(v) - 2 * y0 - height)),
          Rational(abs(width * height))};
}

/// (a, b, c) of the edge opposite corner i, times the orientation.
inline std::array<Rational, 3> exact_coefficients(const Corners& corners, int orientation,
                                                  std::size_t i) {
  const glm::vec4& p = corners[(i + 1) % 3];
  const glm::vec4& q = corners[(i + 2) % 3];
  const auto minor = [orientation](float a, float b, float c, float d) {
    return Rational(orientation * (Rational(a) * Rational(b) - Rational(c) * Rational(d)));
  };
  return {minor(p.y, q.w, p.w, q.y), minor(p.w, q.x, p.x, q.w), minor(p.x, q.y, p.y, q.x)};
}

/// The weights E_0, E_1, E_2, exactly.
inline std::array<Rational, 3> exact_weights(const Corners& corners, int orientation,
                                             const State& state, double u, double v) {
  const std::array<Rational, 3> at = exact_position(state, u, v);
  std::array<Rational, 3> e;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<Rational, 3> k = exact_coefficients(corners, orientation, i);
    e[i] = k[0] * at[0] + k[1] * at[1] + k[2] * at[2];
  }
  return e;
}

/// A sample of a random pixel of a draw, or the pixel's centre.
inline SampleOffset random_sample(Random& random, const DrawBounds& bounds, int samples) {
  const auto pattern = standard_pattern(samples);
  SampleOffset at = kPixelCenter;
  if (!random.one_in(4)) {
    at = pattern[static_cast<std::size_t>(random.between(0, samples - 1))];
  }
  at.x += random.between(bounds.columns.begin, bounds.columns.end - 1);
  at.y += random.between(bounds.rows.begin, bounds.rows.end - 1);
  return at;
}

/// A draw with its frame, and with corners that are not degenerate.
struct FramedDraw {
  State state;
  SmallMesh mesh;
  int samples = 1;
  DrawBounds bounds;
  SampleFrame frame;
  Corners corners;
  int orientation = 0;
};

/// Targets from small to the largest possible; viewports and corners of every kind.
FramedDraw random_framed_draw(Random& random);

}  // namespace rastercheck::rasterizer
