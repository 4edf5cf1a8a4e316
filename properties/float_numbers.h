#pragma once

// Float arithmetic on numbers: the nearest float, its neighbours, and the unit of errors. Makes no
// random choices (random_floats.h does).

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rastercheck::properties {

/// 2^e, −1022 <= e <= 1023.
constexpr double power_of_two(int e) {
  constexpr int kBias = std::numeric_limits<double>::max_exponent - 1;
  constexpr int kFractionBits = std::numeric_limits<double>::digits - 1;
  return std::bit_cast<double>(static_cast<std::uint64_t>(e + kBias) << kFractionBits);
}

/// ulp(x) of float32 (RULES §5), continued by powers of two beyond the range of float32.
inline double ulp_of(double x) {
  constexpr int kLeastExponent = -126;
  constexpr int kFractionBits = 23;
  const int exponent = x == 0 ? kLeastExponent : std::max(std::ilogb(x), kLeastExponent);
  return std::ldexp(1.0, exponent - kFractionBits);
}

/// A computed value as a double; infinity counts as 2^128, as it does for the judge
/// (oracle/judge.h).
inline double number_of(float value) {
  constexpr double kBeyondFloat = 0x1p128;
  return std::isinf(value) ? std::copysign(kBeyondFloat, double{value}) : double{value};
}

/// The nearest float32; beyond the range, the largest finite float32 with that sign.
float to_float(double value);

/// The float32 `steps` floats above (if negative, below) a finite `value`; ±0 count as one float.
/// The result is clamped to the finite floats.
float stepped(float value, int steps);

}  // namespace rastercheck::properties
