#pragma once

// Floats as the numbers that they are: the nearest one, its neighbours, and the unit that errors
// are counted in. No random choice is made here (random_floats.h).

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

/// The nearest float32, the largest one of its sign where it is beyond them.
float to_float(double value);

/// The float32 that lies `steps` floats above (below, where negative) a finite `value`; ±0 count as
/// one. Held at the largest floats.
float stepped(float value, int steps);

}  // namespace rastercheck::properties
