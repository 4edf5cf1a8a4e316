#pragma once

// Which subpixel grid window positions are rounded to, and how: read from coverage alone.
//
// Vertices are placed exactly, on a grid of 2^-18 pixels, w = 1, in a viewport of 64×64 pixels at
// the origin: a float32 viewport transform has nothing to round, so what moves them is rounding to
// the backend's own grid. An edge is laid exactly through a sample, and its ends are then moved by
// a few units of 2^-k pixels, k = 1…18: whether the sample is drawn tells where the ends went, and
// triangles with k near the grid's own bits tell the most. What a grid, or none, would draw of each
// triangle is worked out in integers; the grid with which all that was drawn agrees is the one.
// Samples that lie on an edge are left out here: who owns them is another measure (ties.h), which
// uses the same drawings.

#include <array>
#include <cstdint>
#include <vector>

#include "properties/probing/subject.h"

namespace rastercheck::properties {

/// Positions in 2^-kFineBits pixels.
inline constexpr int kFineBits = 18;

/// How a coordinate goes to the grid; `down` and `up` are towards −∞ and +∞.
enum class GridRounding { nearest_even, half_up, half_down, down, up };

/// A grid of 2^-bits pixels; of kFineBits bits: positions stay as they are.
struct MeasuredGrid {
  int bits = kFineBits;
  GridRounding x = GridRounding::nearest_even;
  GridRounding y = GridRounding::nearest_even;
  bool is_none() const { return bits == kFineBits; }
  bool operator==(const MeasuredGrid&) const = default;
};

/// The grid point that a fine coordinate goes to, in fine units.
std::int64_t rounded(std::int64_t fine, int bits, GridRounding rounding);

/// Window positions, fine.
struct FineTriangle {
  std::array<std::int64_t, 3> x{};
  std::array<std::int64_t, 3> y{};
};
FineTriangle rounded(const FineTriangle& triangle, const MeasuredGrid& grid);
/// Twice the area in window coordinates, with its sign.
std::int64_t area_of(const FineTriangle& triangle);

/// A sample's place in a triangle: by the inward normals of its edges.
struct FinePlace {
  bool is_inside = false;     ///< of all edges, or on them
  int zero_edges = 0;         ///< how many it lies on
  std::int64_t normal_x = 0;  ///< of the last of these
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

/// Draws such triangles in a 64×64 case; nothing where the backend does not.
std::optional<FineDrawing> draw_fine(Subject& subject, const std::vector<FineTriangle>& triangles);

/// The clip position of a fine window position in a base() case.
cases::ClipVertex fine_vertex(const cases::Case& c, std::int64_t x, std::int64_t y, float depth);

struct GridFit {
  MeasuredGrid grid;
  std::uint64_t samples = 0;     ///< that decided
  std::uint64_t mismatches = 0;  ///< of these, drawn otherwise
  double farthest = 0;           ///< pixels by which an edge has to move to mend the worst of these
};

/// Drawings that tell grids apart.
std::vector<FineDrawing> draw_grid_cases(Subject& subject);
/// The grid that agrees best.
GridFit fit_grid(const std::vector<FineDrawing>& drawings);

/// "8 bits, nearest_even", "none".
std::string to_string(const MeasuredGrid& grid);

}  // namespace rastercheck::properties
