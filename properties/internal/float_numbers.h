#pragma once

// Computed floats as numbers, and the unit that their errors are counted in.

#include <algorithm>
#include <cmath>

namespace rastercheck::properties {

/// ulp(x) of float32 (RULES §5), and its powers of two beyond those of float32.
inline double ulp_of(double x) {
  constexpr int kLeastExponent = -126;
  constexpr int kFractionBits = 23;
  const int exponent = x == 0 ? kLeastExponent : std::max(std::ilogb(x), kLeastExponent);
  return std::ldexp(1.0, exponent - kFractionBits);
}

/// A computed value as a number: an infinity stands for 2^128, as it does for the judge
/// (oracle/judge.h).
inline double number_of(float value) {
  constexpr double kBeyondFloat = 0x1p128;
  return std::isinf(value) ? std::copysign(kBeyondFloat, double{value}) : double{value};
}

}  // namespace rastercheck::properties
