#pragma once

// The units in the last place of float32, as exponents of 2 (RULES §5).

#include <algorithm>
#include <cmath>

namespace rastercheck::oracle {

/// The exponent of the least normal float32, and the number of its fraction bits.
inline constexpr int kLeastExponent = -126;
inline constexpr int kFractionBits = 23;
inline constexpr int kLeastUlpExponent = kLeastExponent - kFractionBits;

/// The exponent of the ulp of numbers from 2^exponent to 2^(exponent + 1).
constexpr long ulp_exponent_at(long exponent) {
  return std::max<long>(exponent, kLeastExponent) - kFractionBits;
}

/// The exponent of ulp(f), f finite.
inline int ulp_exponent(float f) {
  return f == 0 ? kLeastUlpExponent : static_cast<int>(ulp_exponent_at(std::ilogb(f)));
}

}  // namespace rastercheck::oracle
