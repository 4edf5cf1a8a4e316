#pragma once

// Window positions on the subpixel grid (RULES §3): which grid points a vertex may be placed on.

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

/// The grid coordinates that a window coordinate (in pixels) may be placed on: one, under a named
/// rounding of the exact position; under a position error e all within 1/2 + e units, inclusive;
/// under an unspecified rounding all within 1 + e units, exclusive: a grid point a whole unit away
/// is not a rounding of the position.
GridRange candidates(const Field& coordinate, const cases::Snapping& snapping);

/// The farthest, in grid units per axis, that a placement may lie from the position.
Ring candidate_radius(const cases::Snapping& snapping);

/// A grid coordinate in pixels.
Ring pixels_of(long coordinate, int subpixel_bits);

/// A vertex that is not clipped, with w > 0, and the grid points it may be placed on.
struct SnappedVertex {
  GridRange x;
  GridRange y;
  Ring w;

  long placements() const { return x.count() * y.count(); }
};
SnappedVertex snap(const RingVector3& window_column, const cases::Snapping& snapping);

/// All columns (x w, y w, w) a vertex may have, x and y in pixels; `corners_only`: those of its
/// extreme placements.
std::vector<RingVector3> placed_columns(const SnappedVertex& vertex, int subpixel_bits,
                                        bool corners_only);

/// The same points in pixels; exact, as a coordinate has 32 bits at most.
std::vector<std::array<double, 2>> placed_points(const SnappedVertex& vertex, int subpixel_bits,
                                                 bool corners_only);

}  // namespace rastercheck::oracle
