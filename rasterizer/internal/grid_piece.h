#pragma once

// Snapped coverage: which samples a polygon of grid points owns, in whole numbers.
//
// The polygon is a fan of pieces, triangles about its first corner. A sample exactly on an edge is
// inside as if it lay infinitely little towards +x and, less still, towards the side that the fill
// rule names: of two pieces or neighbours that share an edge exactly one owns it. Rounding may turn
// a piece round where corners come closer than a grid unit. So pieces count, +1 or −1 as they turn,
// and what counts more than 0 in the sense of the whole is drawn: at least one of the polygons that
// meet at an edge covers every sample along it, whatever rounding did to them.
//
// Along a row an edge is one comparison of whole numbers, so its crossing is one division.

#include <array>
#include <span>
#include <vector>

#include "rasterizer/internal/draw_bounds.h"
#include "rasterizer/internal/grid_line.h"
#include "rasterizer/internal/grid_polygon.h"
#include "rasterizer/internal/standard_pattern.h"

namespace rastercheck::rasterizer {

/// A triangle of grid points that is no line.
struct GridPiece {
  std::array<std::size_t, 3> corners{};  ///< of the polygon
  int turn = 1;                          ///< 1: from x to y
  Wide area = 0;                         ///< twice its area, > 0
  std::array<GridLine, 3> edges;         ///< opposite each corner, not negative inside
};

/// The fan of a polygon.
void grid_pieces(std::span<const GridCorner> corners, std::vector<GridPiece>& out);

/// Twice the area, positive where the polygon turns from x to y.
Wide signed_area(std::span<const GridPiece> pieces);

/// A sample in grid units.
GridPoint grid_sample(int x, int y, const SampleOffset& offset, int unit_bits);

/// The pixels of a row whose sample the piece owns. `tie_sign`: where a normal has a = 0, a sample
/// on the edge is inside iff tie_sign · b > 0.
PixelRange covered_pixels(const GridPiece& piece, const PixelRange& columns, int y,
                          const SampleOffset& offset, int unit_bits, int tie_sign);

/// The pixels that a polygon may cover samples of.
PixelBox touched_pixels(std::span<const GridCorner> corners, int unit_bits, const PixelBox& within);

}  // namespace rastercheck::rasterizer
