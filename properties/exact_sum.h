#pragma once

// Sums of doubles without rounding, for laws that change a case's numbers.

#include <optional>
#include <span>

namespace rastercheck::properties {

/// Returns a + b if a double holds the sum exactly.
std::optional<double> exact_sum(double a, double b);

/// True if a float32 holds `value` exactly.
bool is_float(double value);

/// The sign of the exact sum of at most 16 finite doubles, −1, 0 or 1. No partial sum may overflow.
int sign_of_sum(std::span<const double> terms);

}  // namespace rastercheck::properties
