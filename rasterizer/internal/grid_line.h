#pragma once

// Edges between grid points, in whole numbers: a x + b y + c, in squares of grid units.
//
// Points within the guard band are below 2^31, so that a and b are below 2^32 + 1, c below 2^64,
// and the line at a sample of a target (below 2^30) below 2^65.

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

/// The line through two points, positive on the side that lies in the direction from x to y of it
/// (the other way round where `turn` is −1).
inline GridLine grid_line(const GridPoint& from, const GridPoint& to, int turn) {
  const std::int64_t a = turn * (from.y - to.y);
  const std::int64_t b = turn * (to.x - from.x);
  return {a, b, -(Wide{a} * from.x + Wide{b} * from.y)};
}

inline int sign(Wide value) { return (value > 0) - (value < 0); }

/// The least whole number that is at least value / divisor; divisor > 0.
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
