#pragma once

#include <optional>

#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/triangle_filter.h"
#include "oracle/internal/triangle_setup.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// Doubles around the depths of a triangle's required and permitted samples, of which a depth test
/// compares many and needs few exactly.
///
/// Where a contract leaves several placements, the depth of any of them at a sample p is that of
/// the exact triangle at a point q (placement_filter.h, whose ρ and S these are)
///
///   |p − q| <= reach S/(1 − ρ),  S = 1 + 2ρ,     of shape cut  |p − q| <= reach,
///
/// so that it is off from the exact depth at p by that times |∂d/∂u| + |∂d/∂v|. With ρ < 1 no
/// placement turns the triangle round, and 1/w > 0 at q where (S − 1)/2, which negative weights sum
/// up to, is less than the share that the least w is of the greatest.
class DepthFilter {
 public:
  /// `coverage` is the triangle's; only of its box's samples is asked.
  DepthFilter(const TriangleSetup& triangle, const TriangleFilter& coverage);

  /// Nothing where doubles are not certain to do; then only the exact depth will.
  std::optional<records::Enclosure> at(int x, int y, const cases::SamplePosition& sample) const;

 private:
  void set_line(const TriangleSetup& triangle, const ProjectiveMap& map, double moved);

  PixelBox box_;
  std::optional<FilterLine> line_;  ///< |det M| times the depth
  double reciprocal_ = 0;           ///< of |det M|
  double radius_ = 0;
  records::Enclosure range_;  ///< that the rules clamp to
};

}  // namespace rastercheck::oracle
