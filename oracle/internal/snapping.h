#pragma once

// Snapping window positions to the subpixel grid (RULES §3): the grid points at which a vertex may
// be placed.

#include <array>
#include <vector>

#include "cases/contract.h"
#include "oracle/internal/number.h"

namespace rastercheck::oracle {

/// A closed range of grid coordinates, in units of 2^-subpixel_bits pixels.
struct GridRange {
  long first = 0;
  long last = 0;
  long count() const { return last - first + 1; }
};

/// The grid coordinates at which a window coordinate (in pixels) may be placed. A named rounding of
/// the exact position allows one. A position error e allows all within 1/2 + e units, inclusive. An
/// unspecified rounding allows all within 1 + e units, exclusive, because a grid point a whole unit
/// away is not a rounding of the position.
GridRange candidates(const Field& coordinate, const cases::Snapping& snapping);

/// The largest distance, in grid units per axis, between a position and its placement.
Ring candidate_radius(const cases::Snapping& snapping);

/// A grid coordinate in pixels.
Ring pixels_of(long coordinate, int subpixel_bits);

/// A vertex that is not clipped, with w > 0, and the grid points it may be placed on.
struct SnappedVertex {
  GridRange x;
  GridRange y;
  Ring w;

  long placements() const { return x.count() * y.count(); }
  /// The number of placements with `corners_only`: the ends of both ranges.
  std::size_t extreme_placements() const {
    const std::size_t ends_of_x = x.count() > 1 ? 2 : 1;
    return y.count() > 1 ? 2 * ends_of_x : ends_of_x;
  }
};
SnappedVertex snap(const RingVector3& window_column, const cases::Snapping& snapping);

/// The columns (x w, y w, w), x and y in pixels, of all placements of a vertex; with
/// `corners_only`, of its extreme placements.
std::vector<RingVector3> placed_columns(const SnappedVertex& vertex, int subpixel_bits,
                                        bool corners_only);

/// The same placements as points in pixels; exact, because a coordinate has at most 32 bits.
std::vector<std::array<double, 2>> placed_points(const SnappedVertex& vertex, int subpixel_bits,
                                                 bool corners_only);

}  // namespace rastercheck::oracle
