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

/// The binary logarithm for curves, where corners of the above would be seen: within 2^-40 of the
/// true one, by sums, products and quotients alone. With m in [1, 2) and z = (m − 1)/(m + 1) < 1/3,
/// ln m = 2 (z + z^3/3 + z^5/5 + …); 12 terms leave less than 3^-25. `value` is positive and
/// finite.
inline double curve_log2(double value) {
  constexpr double kTwoOverLn2 = 2.8853900817779268;
  constexpr int kTerms = 12;
  int exponent = 0;
  const double m = 2 * std::frexp(value, &exponent);
  const double z = (m - 1) / (m + 1);
  double sum = 0;
  for (int k = kTerms - 1; k >= 0; --k) sum = sum * (z * z) + 1.0 / (2 * k + 1);
  return exponent - 1 + kTwoOverLn2 * z * sum;
}

}  // namespace rastercheck::reports
