#pragma once

// Serves lines (primitive_drawing.h).
//
// The samples that a line covers before anything is clipped (LineMode), as exact arithmetic
// decides.
//
// Let (X, w)_k be the ends as window columns (window_column.h), and
//
//   d = w_a X_b − w_b X_a      n = d or, for a parallelogram, the part of d along the major axis
//   g_k = n·(p w_k − X_k)      E_a = −g_b, E_b = g_a
//   M = (X, w)_a × (X, w)_b · (p, 1)
//
// E_a and E_b are the weights of the ends (Weights, but of two), for w of either sign: a sample is
// between the ends, or in front of the eye beyond one of them, iff neither is negative. |M| is the
// distance of p from the line times |d|, or the distance along the minor axis times d's major part.
//
// Rectangle: 4 M² <= (2 width)² |d|² in half pixels, which double decides where it can. Where it
// cannot, both sides are scaled by a power of two to about 1 and squared; bits below 2^-1074 are
// then lost, so that a tie would be decided wrongly if the numbers of one end spanned more than 250
// powers of two and the other's likewise.
//
// Bresenham. In a column of pixels (or row, if y is the major axis) the line leaves only one open
// diamond on its whole way: that of the pixel whose row holds the line where it crosses the
// column's middle. The pixel is selected iff the second end is at or beyond the place where the
// line leaves its diamond, and the first is before it. For a point of the line in that column and
// row, let `along` be how far it is past the middle in the line's direction along the major axis,
// and `beside` its distance from the middle along the minor one; it is past the diamond iff along
// > 0 and along + beside >= 1/2. Ties follow from the move by −(ε, ε²), or under D3D from the
// edges that a diamond has.

#include <array>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/exact_plane.h"
#include "rasterizer/internal/window_column.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// The weights of a line's two ends, as affine functions of the window.
struct LineWeights {
  std::array<ExactPlane, 2> e;
  /// n: E_a grows along −w_b n, E_b along w_a n.
  std::array<ExactSum, 2> direction;
};

/// Returns n and the weights. n is zero for a line without length.
LineWeights line_weights(const std::array<WindowColumn, 2>& ends, LineMode mode);

class LineShape {
 public:
  /// The line must have a length. `tie_sign` is that of DrawSetting.
  LineShape(const State& state, const std::array<WindowColumn, 2>& ends, int tie_sign);

  const LineWeights& weights() const { return weights_; }
  /// True if the sample is covered, which covers no more than its place says. Not for Bresenham's
  /// lines.
  bool covers(const HalfPixels& p) const;
  /// True if one of Bresenham's lines selects the pixel.
  bool selects(int x, int y) const;

  /// The pixels that may have covered samples: all of them, and a few more.
  PixelBox box(const PixelBox& bounds) const;
  /// Likewise in a row of pixels.
  PixelRange span(const PixelRange& columns, int y) const;

 private:
  bool owns(int normal_x, int normal_y) const;
  int compare_with_width(const HalfPixels& p) const;
  int compare_exactly_with_width(const HalfPixels& p) const;
  bool is_crossed_in(int x, int y) const;
  bool is_past(std::size_t end, int x, int y) const;
  bool is_past_on_the_border(const std::array<int, 2>& from_middle) const;

  const State& state_;
  int tie_sign_;
  std::array<WindowColumn, 2> ends_;
  std::array<HalfPixels, 2> near_{};  ///< of ends with w > 0
  std::array<int, 2> w_signs_{};
  LineWeights weights_;
  ExactPlane middle_;                  ///< M
  std::array<ExactSum, 2> direction_;  ///< d
  std::array<double, 2> near_direction_{};
  std::array<int, 2> signs_{};  ///< of d
  std::size_t major_ = 0;       ///< the axis
  int copies_ = 1;              ///< of a pixel, along the minor axis
  double reach_ = 0;            ///< no less than |M| at covered samples
};

}  // namespace rastercheck::rasterizer
