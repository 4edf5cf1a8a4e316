#pragma once

#include <array>

#include "cases/case.h"

namespace rastercheck::cases {

/// An axis-aligned box in object space, `lo` <= `hi`, both finite.
struct Bounds {
  std::array<double, 3> lo{};
  std::array<double, 3> hi{};
};

/// Returns a perspective camera that sees all of `bounds`. The camera looks at the box's centre
/// from front, right and above. Along the shorter side of a picture with the aspect ratio
/// `width_over_height`, half the field of view has the slope 1/2. The camera is as close as it can
/// be while it still sees the box's bounding sphere, enlarged by 5%. Clip space follows `rules`;
/// object +y appears up.
Camera frame(const Bounds& bounds, Rules rules, double width_over_height);

}  // namespace rastercheck::cases
