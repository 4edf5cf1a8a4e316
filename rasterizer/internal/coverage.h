#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// The interface of a coverage mode, ExactCoverage (exact_coverage.h), ConservativeCoverage
// (conservative_coverage.h) or GridCoverage (grid_coverage.h), as the templates in
// fragment_drawing.cpp and fallback_drawing.cpp use it.
//
//   locate(triangle)            returns the triangle's fate; if it is drawn, sets box()
//   set_up(triangle, parts)     like locate(); also prepares the calls below and sets up the parts
//                               that the triangle is drawn in, without their values
//   box()                       returns the pixels that the triangle may touch
//   span(sample, y)             returns the pixels of a row that the triangle may touch
//   cover(sample, y, first, count, weights)
//                               returns the covered ones of `count` pixels of a row
//   kLeavesWeights              true if cover() leaves the weights of the only part in `weights`
//   part_mask(block, part)      returns the samples of the last block that belong to a part
//   part_at(u, v)               returns the part that a window position belongs to
//   is_front()                  true if the triangle is a front face
//   polygon()                   returns the drawn polygon of grid points, or nullptr
//   corners_at(u, v)            returns the polygon's three corners around a window position
//
// Triangles are InputTriangles. All calls refer to the triangle that was set up last.

#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

/// The covered samples of a block.
struct CoveredBlock {
  Mask covered = 0;
  Mask in_doubt = 0;  ///< covered samples that double alone could not decide
  /// Covered samples that may lie exactly at a vertex: two E_i are 0, or within their bands. The
  /// value of a sample at a vertex must be the vertex's, unchanged.
  Mask at_vertex = 0;
  bool is_whole_numbers = false;  ///< true if coverage was decided in integers, on the grid

  void keep(Mask wanted) {
    covered &= wanted;
    in_doubt &= wanted;
    at_vertex &= wanted;
  }
};

/// A part of the drawn triangle, with its own weights.
struct DrawnPart {
  Weights weights;
  ValueSource source;
  TriangleValues values;
  TriangleDerivatives derivatives;  ///< set up only with State::derivatives
  /// True if the triangle has no area (Conservative::outer): all values are copied.
  bool is_flat = false;
};

}  // namespace rastercheck::rasterizer
