#pragma once

#include <optional>

#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/triangle_filter.h"
#include "oracle/internal/triangle_setup.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// Doubles around the depths of a triangle's required and permitted samples, of which a depth test
/// compares many and needs few exactly.
class DepthFilter {
 public:
  /// `coverage` is the triangle's; only of its box's samples is asked.
  DepthFilter(const TriangleSetup& triangle, const TriangleFilter& coverage);

  /// Nothing where doubles are not certain to do; then only the exact depth will.
  std::optional<records::Enclosure> at(int x, int y, const cases::SamplePosition& sample) const;

 private:
  PixelBox box_;
  std::optional<FilterLine> line_;  ///< |det M| times the depth
  double reciprocal_ = 0;           ///< of |det M|
  double radius_ = 0;
  records::Enclosure range_;  ///< that the rules clamp to
};

}  // namespace rastercheck::oracle
