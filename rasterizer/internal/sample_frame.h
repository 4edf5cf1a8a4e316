#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Samples in homogeneous coordinates of clip space. Edge functions of such samples need no
// division, and clip positions need no viewport transform (RULES §6).
//
//   U = sign(W) |H| (2u − 2x0 − W)      V = ±sign(H) |W| (2v − 2y0 − H)      T = |W H|
//
// (− for D3D). (U, V, T) is a positive multiple of the NDC position (ξ, η, 1) of the window
// position (u, v) under the viewport (x0, y0, W, H). Folding the viewport into the vertices instead
// is not exact in double, and can flip the sign of an edge.

#include <array>
#include <cstddef>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// One of the two axes. `at(position)` maps a window coordinate in pixels to scale · (2
/// position − shift).
struct AxisFrame {
  double scale = 0;
  double shift = 0;  ///< 2x0 + W, rounded
  /// True if `at` is exact for every sample of a target.
  bool is_exact = false;
  /// Maximum error of `at` over the pixels of the draw; 0 if `at` is exact.
  double error = 0;
  /// Maximum magnitude of `at` over the pixels of the draw.
  double greatest = 0;
  /// If `at` is exact, all its values are multiples of 2^grain.
  int grain = 0;
  /// Without rounding, `at` is scale · (2 position − 2 origin − size).
  float origin = 0;
  float size = 0;
  /// The sign of dU/du (of dV/dv), 1 or −1.
  int direction = 1;

  double at(double position) const { return scale * (2 * position - shift); }
};

struct SampleFrame {
  AxisFrame u;
  AxisFrame v;
  double t = 0;  ///< exact

  /// Converts an orientation in clip space, 1 or −1, to the orientation as displayed. A viewport
  /// may mirror it.
  int displayed(int turn) const { return turn * u.direction * v.direction; }
};

/// Makes the frame of a draw. The viewport's width and height must not be 0.
SampleFrame sample_frame(const State& state, const DrawBounds& bounds, int samples);

/// A coordinate as an exact sum of products of two doubles: sum over i of scale · parts[i].
struct ExactCoordinate {
  std::array<double, 3> parts{};
  std::size_t size = 0;
  double scale = 0;
};
ExactCoordinate exact_at(const AxisFrame& axis, double position);

/// Returns the exponent of the lowest set bit. For 0, returns a number that is above all exponents
/// and can be doubled without overflow.
int lowest_bit(double value);

}  // namespace rastercheck::rasterizer
