#pragma once

#include <string>

#include "oracle/triangle_truth.h"

namespace rastercheck::properties {

/// Digits of a fraction beyond which some are left out.
inline constexpr std::size_t kMostDigits = 200;

/// A fraction, "p/q" or "p". Of one with more digits a numerator or denominator of more than half
/// as many keeps its first and its last ones, with "…" between them.
std::string elided(const oracle::Rational& value);

/// "[fraction, fraction]", or one fraction where both ends are one.
std::string elided(const oracle::ValueRange& range);

}  // namespace rastercheck::properties
