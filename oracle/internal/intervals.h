#pragma once

// The cascade's second level: interval arithmetic, which bounds the rounding that actually
// occurred, not the worst that might occur. It is exact as long as the numbers fit into doubles, as
// they do on grids, so it decides a sample on an edge or an error of exactly half an ULP.
//
// CGAL::Interval_nt<false> leaves the rounding mode to its user: an UpwardRounding must be alive
// during all arithmetic on Interval.

#include <CGAL/Interval_nt.h>

#include "oracle/internal/number.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

using Interval = CGAL::Interval_nt<false>;
using UpwardRounding = Interval::Protector;

inline Interval interval_of(const Ring& value) {
  const records::Enclosure around = enclose(value);
  return {around.lo, around.hi};
}

/// The line a·x + b·y + c in positions relative to a pixel.
struct IntervalLine {
  Interval a;
  Interval b;
  Interval c;

  Interval at(double x, double y) const { return a * Interval(x) + b * Interval(y) + c; }
};

}  // namespace rastercheck::oracle
