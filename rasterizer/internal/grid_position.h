#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Window positions on the subpixel grid (RULES §3, `snapped`), exactly rounded.
//
// Twice a vertex's window position times its w is a sum of three products of two floats,
//
//   N_x = x W + w 2x0 + w W      N_y = ±y H + w 2y0 + w H      (− for D3D),
//
// so the vertex is snapped to the grid point k to which N 2^(b−1) / w rounds. In double, the
// quotient has an error of a few 2^-53 of its terms. If it is too close to the middle between two
// points, the sign of N 2^b − (2k + 1) w, a sum without rounding, decides; for Rounding::floor, if
// it is too close to a point, the sign of N 2^b − 2k w.
//
// Points are counted in units of 2^-u pixels, where u is the larger of b and 4. Samples, whose
// offsets are sixteenths of a pixel, are then grid points too.

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "rasterizer/internal/exact_sum.h"
#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// A point in units of 2^-u pixels. Within the guard band |x| and |y| are at most 2^31.
struct GridPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  bool operator==(const GridPoint&) const = default;
};

/// The viewport of a draw along one axis, as used in N.
struct GridAxis {
  double slope = 0;   ///< ±W (±H)
  double origin = 0;  ///< 2x0 (2y0)
  double size = 0;    ///< W (H)
};

struct Grid {
  GridAxis x;
  GridAxis y;
  Snapping snapping;
  int unit_bits = 0;  ///< u
};

/// Returns the axes of a draw's window.
std::array<GridAxis, 2> window_axes(const State& state);

/// Returns u for a snapping.
int unit_bits(const Snapping& snapping);

/// Returns the point that a position halfway between two points rounds to, unless by
/// Rounding::floor; `below` is the lower of the two. All are in units of 2^-b pixels.
std::int64_t tie_point(Rounding rounding, std::int64_t below);

Grid grid_of(const State& state);

/// Adds factor · N of a vertex to the sum.
void add_window_numerator(ExactSum& sum, const GridAxis& axis, float coordinate, float w,
                          double factor);

/// True if the vertex has w > 0 and lies within the guard band.
bool is_within_guard_band(const Grid& grid, const glm::vec4& position);

/// Returns the grid point of a vertex within the guard band.
GridPoint snapped(const Grid& grid, const glm::vec4& position);

}  // namespace rastercheck::rasterizer
