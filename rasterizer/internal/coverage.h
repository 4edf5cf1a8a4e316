#pragma once

// What drawing.cpp and lane_drawing.cpp, templates of it, ask of a mode of coverage: ExactCoverage
// (exact_coverage.h) or GridCoverage (grid_coverage.h).
//
//   locate(triangle)            what becomes of a triangle, and if it is drawn where: sets box()
//   set_up(triangle, parts)     the same, and prepares it for what follows, with the parts that it
//                               is drawn in, whose values are not set up
//   box()                       the pixels that it may touch
//   span(sample, y)             those of a row that it may touch
//   cover(sample, y, first, count, weights)
//                               what it covers of `count` pixels of a row
//   kLeavesWeights              whether that leaves the weights of the one part there is behind
//   part_mask(block, part)      which samples of the last block belong to a part
//   part_at(u, v)               the part that a window position belongs to
//   polygon()                   the polygon of grid points that is drawn; nullptr where none is
//   corners_at(u, v)            the three of its corners that a window position lies between
//
// Triangles are InputTriangles; the last one set up is meant.

#include "rasterizer/internal/derivatives.h"
#include "rasterizer/internal/exact_values.h"
#include "rasterizer/internal/masks.h"
#include "rasterizer/internal/weights.h"

namespace rastercheck::rasterizer {

/// What of a block is covered.
struct CoveredBlock {
  Mask covered = 0;
  Mask in_doubt = 0;  ///< of these, the samples that double alone did not decide
  /// Of these, the samples that may lie exactly at a vertex, whose value is then to come back as it
  /// is: two edges are within their bands, or 0.
  Mask at_vertex = 0;
  bool is_whole_numbers = false;  ///< decided on the grid

  void keep(Mask wanted) {
    covered &= wanted;
    in_doubt &= wanted;
    at_vertex &= wanted;
  }
};

/// One part of what is drawn of a triangle, with weights of its own.
struct DrawnPart {
  Weights weights;
  ValueSource source;
  TriangleValues values;
  TriangleDerivatives derivatives;  ///< set up where State::derivatives
};

}  // namespace rastercheck::rasterizer
