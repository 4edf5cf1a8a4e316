#pragma once

// Tells how a backend's depth test may order two depths that the backend reports as float32.

#include <algorithm>
#include <cmath>

#include "cases/contract.h"
#include "properties/float_numbers.h"

namespace rastercheck::properties {

/// The depth test compares stored depths k(d), computed from a depth d before d is rounded to
/// float32. If d < e, then k(d) <= k(e), and k(d) = k(e) only if d and e are at most one step
/// apart. The reported float32 is within half a float spacing of d.
class DepthOrder {
 public:
  explicit DepthOrder(cases::DepthFormat format)
      : step_(cases::depth_step(format)), is_float32_(format == cases::DepthFormat::float32) {}

  bool may_be_less(float a, float b) const { return a < b || (!is_float32_ && a == b); }
  bool is_surely_less(float a, float b) const {
    const double spacing = step_ > 0 ? ulp_of(std::max(std::fabs(a), std::fabs(b))) : 0;
    return a<b&& double{b} - double{a}> step_ + spacing;
  }

 private:
  double step_;
  bool is_float32_;  ///< if false, equal floats may stand for different depths
};

}  // namespace rastercheck::properties
