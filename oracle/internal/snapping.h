#pragma once

// Snapping window positions to the subpixel grid (RULES §3): the grid points at which a vertex may
// be placed.

#include <array>
#include <vector>

#include "cases/contract.h"
#include "oracle/internal/number.h"

namespace rastercheck::oracle {

/// A closed range of grid coordinates, in grid units.
struct GridRange {
  long first = 0;
  long last = 0;
  long count() const { return last - first + 1; }
};

/// The grid coordinates at which a window coordinate (in pixels) along an axis may be placed. A
/// named rounding of the exact position allows one. With a position error e, a rounding to the
/// nearest allows all within 1/2 + e units, inclusive, and a rounding in one direction the
/// roundings of all positions within e units. An unspecified rounding allows all within 1 + e
/// units, exclusive, because a grid point a whole unit away is not a rounding of the position.
GridRange candidates(const Field& coordinate, const cases::Snapping& snapping,
                     std::size_t axis = 0);

/// The largest distance, in grid units per axis, between a position and its placement.
Ring candidate_radius(const cases::Snapping& snapping);

/// A grid coordinate times `unit` (Scene::grid_unit).
Ring window_of(long coordinate, double unit);

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
/// `units_per_pixel`: Scene::units_per_pixel().
SnappedVertex snap(const RingVector3& window_column, const cases::Snapping& snapping,
                   const Ring& units_per_pixel);

/// The columns (x w, y w, w) of all placements of a vertex, x and y in window units; with
/// `corners_only`, of its extreme placements. `unit`: Scene::grid_unit().
std::vector<RingVector3> placed_columns(const SnappedVertex& vertex, double unit,
                                        bool corners_only);

/// The same placements as points; exact, because a coordinate has at most 32 bits and a unit at
/// most 13.
std::vector<std::array<double, 2>> placed_points(const SnappedVertex& vertex, double unit,
                                                 bool corners_only);

}  // namespace rastercheck::oracle
