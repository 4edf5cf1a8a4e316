#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Edges between grid points, in whole numbers: a x + b y + c, in squares of grid units.
//
// In magnitude, coordinates within the guard band are at most 2^31, so a and b are at most 2^32, c
// is below 2^64, and the line at a sample of a target (below 2^30) is below 2^65.

#include <cstdint>

#include "rasterizer/internal/grid_position.h"

namespace rastercheck::rasterizer {

__extension__ using Wide = __int128;

struct GridLine {
  std::int64_t a = 0;
  std::int64_t b = 0;
  Wide c = 0;

  Wide at(const GridPoint& p) const { return Wide{a} * p.x + Wide{b} * p.y + c; }
};

/// Returns the line through two points. Rotate the direction from → to by 90 degrees, in the sense
/// from +x to +y: with `turn` 1 the line is positive on the side that the rotated direction points
/// to; with `turn` −1, on the other side.
inline GridLine grid_line(const GridPoint& from, const GridPoint& to, int turn) {
  const std::int64_t a = turn * (from.y - to.y);
  const std::int64_t b = turn * (to.x - from.x);
  return {a, b, -(Wide{a} * from.x + Wide{b} * from.y)};
}

inline int sign(Wide value) { return (value > 0) - (value < 0); }

/// Returns the least whole number not less than value / divisor; `divisor` must be positive.
inline Wide ceiling_quotient(Wide value, std::int64_t divisor) {
  const auto narrow = static_cast<std::int64_t>(value);
  if (narrow == value) {  // several times faster
    const std::int64_t quotient = narrow / divisor;
    return quotient + (narrow % divisor > 0 ? 1 : 0);
  }
  const Wide quotient = value / divisor;
  return quotient + (value % divisor > 0 ? 1 : 0);
}

}  // namespace rastercheck::rasterizer
