#pragma once

// Serves every route (docs/rasterizer.md, Routes).
//
// Depths as they are stored (DepthFormat): as floats, or as the float nearest to k/s, where k is a
// whole number and s = 2^b − 1 is the number of steps of a unorm format of b bits.
//
//   k        is nearest to d s, which has one rounding, 2^-53 s < 2^-28 of a step. A whole number
//            below 2^51 is what is left after 2^52 is added and subtracted; both round to nearest,
//            ties to even, on all targets alike.
//   the float is the double nearest to k/s, rounded. Rounding twice goes wrong only where the bits
//   of
//            k/s after the 24th significant one are, up to the 53rd, a one and then zeros or a zero
//            and then ones, 28 of them. The binary digits of k/s are the b <= 24 digits of k over
//            and over, so 28 equal ones are k = 0 or k = s, which are exact.
//   order    each of these operations is monotone. k/s and (k + 1)/s are at least 2^-24 apart, and
//            floats below 1 at most 2^-24, so different k give different floats.

#include "rasterizer/rasterizer.h"

namespace rastercheck::rasterizer {

/// The greatest k of a unorm format; 0 for float32.
constexpr double depth_steps(DepthFormat format) {
  switch (format) {
    case DepthFormat::unorm16:
      return 0xffff;
    case DepthFormat::unorm24:
      return 0xffffff;
    case DepthFormat::float32:
      break;
  }
  return 0;
}

/// A number x of 0 … 2^51 is rounded to the nearest whole number by (x + kToWhole) − kToWhole.
inline constexpr double kToWhole = 0x1p52;

/// The number stored for a depth, which must be within [0, 1] if `steps` (depth_steps()) is not 0.
inline float stored(double depth, double steps) {
  if (steps == 0) return static_cast<float>(depth);
  const double k = (depth * steps + kToWhole) - kToWhole;
  return static_cast<float>(k / steps);
}

}  // namespace rastercheck::rasterizer
