#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Snapped coverage: decides in whole numbers which samples a polygon of grid points owns.
//
// The polygon is a fan of pieces, which are triangles that share the polygon's first corner. A
// sample exactly on an edge is treated as if moved infinitesimally towards +x and, by even less,
// towards the side that the fill rule names. So if two pieces or two neighbouring triangles share
// an edge, exactly one of them owns the sample. Rounding may flip a piece if corners are closer
// than a grid unit. Each piece therefore counts +1 if it turns like the whole polygon, else −1, and
// a sample is drawn if the pieces that own it add up to more than 0. As a result, every sample
// along an edge is covered by at least one of the polygons that meet there, however rounding moved
// them.
//
// Along a row, an edge is one comparison of whole numbers, so finding its crossing takes one
// division.

#include <array>
#include <span>
#include <vector>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/grid_line.h"
#include "rasterizer/internal/grid_polygon.h"
#include "rasterizer/internal/standard_pattern.h"

namespace rastercheck::rasterizer {

/// A triangle of grid points with nonzero area.
struct GridPiece {
  std::array<std::size_t, 3> corners{};  ///< indices into the polygon's corners
  int turn = 1;                          ///< 1 if it turns from x to y, else −1
  Wide area = 0;                         ///< twice the piece's area, > 0
  std::array<GridLine, 3> edges;         ///< edges[i] is opposite corner i; not negative inside
};

/// Computes the pieces of a polygon.
void grid_pieces(std::span<const GridCorner> corners, std::vector<GridPiece>& out);

/// Returns twice the polygon's area; positive if the polygon turns from x to y.
Wide signed_area(std::span<const GridPiece> pieces);

/// Returns the position of a sample in grid units.
GridPoint grid_sample(int x, int y, const SampleOffset& offset, int unit_bits);

/// Returns the pixels of a row whose sample the piece owns. `tie_sign`: a sample on an edge whose
/// normal has a = 0 is inside iff tie_sign · b > 0.
PixelRange covered_pixels(const GridPiece& piece, const PixelRange& columns, int y,
                          const SampleOffset& offset, int unit_bits, int tie_sign);

/// Returns the pixels of `within` whose samples a polygon may cover.
PixelBox touched_pixels(std::span<const GridCorner> corners, int unit_bits, const PixelBox& within);

}  // namespace rastercheck::rasterizer
