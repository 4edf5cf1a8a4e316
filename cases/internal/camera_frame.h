#pragma once

#include <array>

#include "cases/case.h"

namespace rastercheck::cases {

/// An axis-aligned box in object space, `lo` <= `hi`, both finite.
struct Bounds {
  std::array<double, 3> lo{};
  std::array<double, 3> hi{};
};

/// A perspective camera that sees the whole of `bounds`: it looks at the box's centre from front,
/// right and above, half the field of view having the slope 1/2, from as near as a sphere
/// a twentieth larger than the box's own allows at the aspect ratio `width_over_height`. Clip space
/// follows `rules`; object +y appears up.
Camera frame(const Bounds& bounds, Rules rules, double width_over_height);

}  // namespace rastercheck::cases
