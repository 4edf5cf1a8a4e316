// Measures what a depth bias adds to depths: its unit, its slope, its clamp, its exponent, and what
// limits the sum. Each has a file of its own.
//
// A finding replaces the contract's `depth_bias` only if it differs from what the backend declares,
// because declared promises may differ by rules.

#include "properties/probing/depth_planes.h"
#include "properties/probing/measures.h"

namespace rastercheck::properties {

void measure_depth_bias(Subject& subject, Sight& sight) {
  if (!subject.capabilities().has(cases::Feature::depth_bias)) {
    subject.add("depth bias", kNotDeclared, "not measured", "the backend draws no such cases");
    return;
  }
  BiasSight bias;
  bias.found = subject.declared().depth_bias;
  measure_bias_unit(subject, sight, bias);
  measure_bias_slope(subject, bias);
  if (bias.float_ratio) {
    measure_bias_exponent(subject, bias);
    measure_bias_limits(subject, bias);
  }
  check_biased_depths(subject, bias);
  if (bias.differs) subject.result.terms.depth_bias = bias.found;
}

}  // namespace rastercheck::properties
