#pragma once

// Says what is known of the order in which a backend's depth tests see depths that it hands over
// as float32.

#include <algorithm>
#include <cmath>

#include "cases/contract.h"
#include "properties/float_numbers.h"

namespace rastercheck::properties {

/// A test compares what is stored, k(d), of a depth d before it was rounded to float32. d < e makes
/// k(d) <= k(e), and equal only where they are a step apart at most; a float32 tells d to half a
/// spacing.
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
  bool is_float32_;  ///< else equal floats may be of depths that differ
};

}  // namespace rastercheck::properties
