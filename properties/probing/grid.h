#pragma once

// Measures the subpixel grid and its rounding from coverage alone.
//
// Vertices are placed exactly, on a grid of 2^-18 pixels, w = 1, in a viewport of 64×64 pixels at
// the origin. A float32 viewport transform has nothing to round, so only rounding to the backend's
// own grid moves them. An edge is laid exactly through a sample, and its ends are then moved by a
// few units of 2^-k pixels, k = 1…18. Whether the sample is drawn shows to which places the ends
// were rounded; drawings with k near the grid's own bits tell the most. Integer arithmetic predicts
// each triangle's drawing for every grid and for none; the measured grid is the one that agrees
// with all drawings. Samples on an edge are left out here: ties_measure.cpp finds out who owns
// them, from drawings of the same triangles.

#include <array>
#include <cstdint>
#include <vector>

#include "properties/probing/subject.h"

namespace rastercheck::properties {

/// Positions in 2^-kFineBits pixels.
inline constexpr int kFineBits = 18;

/// Rounding of a coordinate to the grid; `down` and `up` are towards −∞ and +∞.
enum class GridRounding { nearest_even, half_up, half_down, down, up };

/// A grid of 2^-bits pixels; kFineBits bits mean no grid.
struct MeasuredGrid {
  int bits = kFineBits;
  GridRounding x = GridRounding::nearest_even;
  GridRounding y = GridRounding::nearest_even;
  bool is_none() const { return bits == kFineBits; }
  bool operator==(const MeasuredGrid&) const = default;
};

/// Rounds a fine coordinate to the grid; the result is in fine units.
std::int64_t rounded(std::int64_t fine, int bits, GridRounding rounding);

/// Window positions, in fine units.
struct FineTriangle {
  std::array<std::int64_t, 3> x{};
  std::array<std::int64_t, 3> y{};
};
FineTriangle rounded(const FineTriangle& triangle, const MeasuredGrid& grid);
/// Returns twice the area in window coordinates, with its sign.
std::int64_t area_of(const FineTriangle& triangle);

/// A sample's place relative to a triangle's edges.
struct FinePlace {
  bool is_inside = false;     ///< inside or on every edge
  int zero_edges = 0;         ///< number of edges through the sample
  std::int64_t normal_x = 0;  ///< inward normal of the last zero edge
  std::int64_t normal_y = 0;
};
FinePlace place_in(const FineTriangle& triangle, int x, int y);

/// Drawings whose positions are known in fine units.
struct FineDrawing {
  std::vector<FineTriangle> triangles;
  /// [triangle][row]: bit x is set where pixel x was drawn.
  std::vector<std::array<std::uint64_t, 64>> rows;
  DrawnCase drawn;
};

/// Draws the triangles in a 64×64 case; empty if the backend does not draw it.
std::optional<FineDrawing> draw_fine(Subject& subject, const std::vector<FineTriangle>& triangles);

/// Returns the clip position of a fine window position in a base() case.
cases::ClipVertex fine_vertex(const cases::Case& c, std::int64_t x, std::int64_t y, float depth);

struct GridFit {
  MeasuredGrid grid;
  std::uint64_t samples = 0;     ///< decisive samples
  std::uint64_t mismatches = 0;  ///< decisive samples that were not drawn as predicted
  double farthest = 0;  ///< distance that an edge must move to explain the worst mismatch, pixels
};

/// Makes drawings that distinguish grids.
std::vector<FineDrawing> draw_grid_cases(Subject& subject);
/// Returns the grid that agrees best.
GridFit fit_grid(const std::vector<FineDrawing>& drawings);

/// Returns text such as "8 bits, nearest_even" or "none".
std::string to_string(const MeasuredGrid& grid);

}  // namespace rastercheck::properties
