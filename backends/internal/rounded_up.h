#pragma once

// How derived bounds become the numbers of a contract.

#include <cmath>
#include <limits>

namespace rastercheck::backends {

/// Error counts are of first order in the relative error of an operation; this factor covers the
/// higher orders.
inline constexpr double kRest = 1.01;

/// The float32 that is no less than a number.
inline float no_less(double number) {
  const auto nearest = static_cast<float>(number);
  return double{nearest} >= number
             ? nearest
             : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

}  // namespace rastercheck::backends
