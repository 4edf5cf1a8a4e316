#pragma once

// Sums of doubles without any rounding: what laws decide about numbers that they change.

#include <optional>
#include <span>

namespace rastercheck::properties {

/// a + b where that is a double.
std::optional<double> exact_sum(double a, double b);

/// Whether a float32 holds it.
bool is_float(double value);

/// The sign of the exact sum of at most 16 finite doubles, −1, 0 or 1. No partial sum may be beyond
/// double.
int sign_of_sum(std::span<const double> terms);

}  // namespace rastercheck::properties
