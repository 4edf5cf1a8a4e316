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
/// so that it is off from the exact depth at p by that times |∂d/∂u| + |∂d/∂v|.
///
/// Any placement counts, also one that does not cover p, as long as it is not turned round (ρ < 1)
/// and has 1/w > 0 at p; else all depths between those of the vertices do. 1/w at p is that of the
/// exact triangle at q, Σ α_i(q)/w_i. As p lies in some placement, q is within 2 reach/(1 − ρ) of a
/// point of the exact triangle, where no α_i is negative. Σ ∂α_i = 0, so that the negative α_i(q)
/// sum up to at most N = ρ/(1 − ρ), as Σ |∂α_i| = ρ/reach. So 1/w > 0 if N/(1 + N) = ρ is less than
/// the share that the least w is of the greatest.
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
