#pragma once

// Measures the subpixel grid and its rounding from coverage alone.
//
// Vertices are placed exactly, on a grid of 2^-18 pixels, w = 1, in a viewport of 64×64 pixels at
// the origin. A float32 viewport transform has nothing to round, so only rounding to the backend's
// own grid moves them. An edge is laid exactly through a sample, and its ends are then moved by a
// few units of 2^-k pixels, k = 1…18. Whether the sample is drawn shows to which places the ends
// were rounded; drawings with k near the grid's own bits tell the most. Integer arithmetic predicts
// each triangle's drawing for every grid and for none, also for positions that are all moved by the
// same before they are rounded. Samples on an edge are left out here: ties_measure.cpp finds out
// who owns them, from drawings of the same triangles.
//
// Samples are expected where the backend declares them. Grids of 2^-n pixels, and moves, are tried
// first; then other grids of 1/n pixel; then samples on a point of a grid. A move of the samples
// and a move of the positions look alike, except that positions are rounded after they are moved.
//
// The finest explanation is taken, and "none" is the finest of all: a coarser grid has to explain
// much more of the samples about which the two disagree. A grid is named only if it is right about
// (nearly) all samples about which it disagrees with "none".

#include <cstdint>
#include <string>
#include <vector>

#include "properties/probing/fine_triangle.h"

namespace rastercheck::properties {

/// Rounding of a coordinate to the grid; `down` and `up` are towards −∞ and +∞.
enum class GridRounding { nearest_even, half_up, half_down, down, up };

/// A grid of 1/steps() pixel; kFineBits bits mean no grid.
struct MeasuredGrid {
  int bits = kFineBits;
  GridRounding x = GridRounding::nearest_even;
  GridRounding y = GridRounding::nearest_even;
  std::int64_t move_x = 0;  ///< fine units by which all positions are moved before rounding
  std::int64_t move_y = 0;
  int odd_steps = 1;  ///< odd; see cases::Snapping
  cases::PixelFraction sample = kPixelCentre;
  bool is_moved() const { return move_x != 0 || move_y != 0; }
  bool is_none() const { return bits == kFineBits; }
  int steps() const { return odd_steps << bits; }
  bool operator==(const MeasuredGrid&) const = default;
};

/// Rounds a coordinate to a multiple of `unit`.
std::int64_t rounded(std::int64_t coordinate, std::int64_t unit, GridRounding rounding);

/// Returns the triangle that a grid makes of fine positions, in units in which grid points are
/// whole.
FineTriangle rounded(const FineTriangle& triangle, const MeasuredGrid& grid);

struct GridFit {
  MeasuredGrid grid;
  std::uint64_t samples = 0;     ///< decisive samples
  std::uint64_t mismatches = 0;  ///< decisive samples that were not drawn as predicted
  std::uint64_t ties = 0;        ///< samples on edges
  double farthest = 0;  ///< distance that an edge must move to explain the worst mismatch, pixels
  /// The greatest edge function, in pixels², that must have come out with the wrong sign to explain
  /// a mismatch.
  double most_wrong = 0;
  /// False if no grid explains the drawings, nor do unrounded positions; `grid` is none then.
  bool is_explained = true;
};

/// Makes drawings that distinguish grids.
std::vector<FineDrawing> draw_grid_cases(Subject& subject);
/// Returns the finest grid that explains the drawings. Ends early if the subject's time is up.
GridFit fit_grid(const Subject& subject, const std::vector<FineDrawing>& drawings);

/// Returns text such as "8 bits, nearest_even" or "none".
std::string to_string(const GridFit& fit);
/// How sure the fit is.
records::Sureness sureness_of(const GridFit& fit);

}  // namespace rastercheck::properties
