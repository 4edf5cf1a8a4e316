#pragma once

// The cascade's second level: interval arithmetic, whose error is what happened and not what might
// have. Exact wherever the numbers fit into doubles, as they do on grids: a sample on an edge, an
// error of just half an ULP.
//
// CGAL::Interval_nt<false> leaves the rounding mode to its user: all that computes with Interval
// lives as long as an UpwardRounding does.

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

/// a·x + b·y + c, of positions relative to a pixel.
struct IntervalLine {
  Interval a;
  Interval b;
  Interval c;

  Interval at(double x, double y) const { return a * Interval(x) + b * Interval(y) + c; }
};

}  // namespace rastercheck::oracle
