#pragma once

// Samples in homogeneous coordinates of clip space, where edge functions need no division and clip
// positions no viewport transform (RULES §6).
//
//   U = sign(W) |H| (2u − 2x0 − W)      V = ±sign(H) |W| (2v − 2y0 − H)      T = |W H|
//
// (− for D3D) is a positive multiple of the NDC position (ξ, η, 1) of the window position (u, v)
// under the viewport (x0, y0, W, H). Folding the viewport into the vertices instead is not exact in
// double, and can turn the sign of an edge.

#include <array>
#include <cstddef>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// One of the two axes: scale · (2 at − shift), `at` a window coordinate in pixels.
struct AxisFrame {
  double scale = 0;
  double shift = 0;  ///< 2x0 + W, rounded
  /// Whether `at` rounds nothing, for every sample of a target.
  bool is_exact = false;
  /// How far `at` may be off, for the pixels of the draw; 0 where it is exact.
  double error = 0;
  /// The largest magnitude over the pixels of the draw.
  double greatest = 0;
  /// Where it is exact, all values are multiples of 2^grain.
  int grain = 0;
  /// scale · (2 at − shift) as the sum of these times the factors (2 at, −1, −1).
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

  /// The orientation as displayed of what turns that way, 1 or −1, in clip space, which a viewport
  /// may mirror.
  int displayed(int turn) const { return turn * u.direction * v.direction; }
};

/// The frame of a draw; the viewport has neither width nor height 0.
SampleFrame sample_frame(const State& state, const DrawBounds& bounds, int samples);

/// A coordinate as a sum of products of two doubles: sum over i of scale · parts[i], exactly.
struct ExactCoordinate {
  std::array<double, 3> parts{};
  std::size_t size = 0;
  double scale = 0;
};
ExactCoordinate exact_at(const AxisFrame& axis, double position);

/// The exponent of the lowest set bit; of 0 a number beyond all exponents, of which two may be
/// added.
int lowest_bit(double value);

}  // namespace rastercheck::rasterizer
