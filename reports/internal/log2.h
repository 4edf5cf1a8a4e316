#pragma once

#include <cmath>

namespace rastercheck::reports {

/// The binary logarithm, for scales to draw on: exact at powers of two, linear between them (at
/// most 0.09 below the true one), increasing. `value` is positive and finite. frexp is exact, so
/// that pictures are the same to the bit wherever they are drawn, which std::log2 does not promise.
inline double drawn_log2(double value) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);  // in [1/2, 1)
  return exponent - 1 + (2 * fraction - 1);
}

}  // namespace rastercheck::reports
