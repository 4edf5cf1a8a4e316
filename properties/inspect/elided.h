#pragma once

#include <string>

#include "oracle/triangle_truth.h"

namespace rastercheck::properties {

/// Number of digits of the longest fraction that is shown in full.
inline constexpr std::size_t kMostDigits = 200;

/// Writes a fraction as "p/q" or "p". In a longer fraction, a numerator or denominator of more than
/// half of kMostDigits keeps only its first and last digits, with "…" between.
std::string elided(const oracle::Rational& value);

/// Writes "[fraction, fraction]", or one fraction if both ends are equal.
std::string elided(const oracle::ValueRange& range);

}  // namespace rastercheck::properties
