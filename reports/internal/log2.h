#pragma once

#include <cmath>

namespace rastercheck::reports {

/// The binary logarithm for scales in drawings: exact at powers of two, linear between them (at
/// most 0.09 below the true value), and increasing. `value` must be positive and finite. frexp is
/// exact, so pictures are the same to the bit on every machine; std::log2 does not promise that.
inline double drawn_log2(double value) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);  // in [1/2, 1)
  return exponent - 1 + (2 * fraction - 1);
}

/// The binary logarithm for curves, in which the corners of drawn_log2() would be visible. It is
/// within 2^-40 of the true value and computed only with sums, products and quotients. With m in
/// [1, 2) and z = (m − 1)/(m + 1) < 1/3, ln m = 2 (z + z^3/3 + z^5/5 + …); the terms after the
/// first 12 sum to less than 3^-25. `value` must be positive and finite.
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
