#pragma once

#include <algorithm>
#include <cmath>

namespace rastercheck::oracle {

/// The exponent of ulp(f), f finite.
inline int ulp_exponent(float f) { return f == 0 ? -149 : std::max(std::ilogb(f), -126) - 23; }

}  // namespace rastercheck::oracle
