#pragma once

#include <optional>

#include "oracle/internal/filter_kernels.h"
#include "oracle/internal/triangle_filter.h"
#include "oracle/internal/triangle_setup.h"
#include "records/enclosure.h"

namespace rastercheck::oracle {

/// The R of DepthFilter, in pixels: if a placement has some value at a covered sample, the exact
/// triangle has that value within this distance along both axes. Empty if doubles cannot tell. Only
/// for shapes placed and cut.
std::optional<double> placement_radius(const TriangleSetup& triangle);

/// The ρ of placement_filter.h: by how much placements may turn or stretch a triangle without
/// vertices behind the eye. Empty if it is not below 1/2. Only for shapes placed and cut.
std::optional<double> placement_turn(const TriangleSetup& triangle);

/// Encloses the depths of a triangle's required and permitted samples in doubles, after bias and
/// clamping. A depth test compares many depths and needs few of them exactly.
///
/// If the contract allows several placements, the depth of each at a sample p is the depth of the
/// exact triangle at some point q (placement_filter.h, which defines ρ and S):
///
///   |p − q| <= R = reach S/(1 − ρ),  S = 1 + 2ρ;     shape cut:  R = reach.
///
/// So the placement's depth differs from the exact depth at p by at most this distance times
/// |∂d/∂u| + |∂d/∂v|.
///
/// The bound includes every placement, even one that does not cover p, if all keep their
/// orientation (as they do for ρ < 1) and have 1/w > 0 at p; otherwise all depths between the
/// vertices' depths are permitted. The 1/w of a placement at p is the exact triangle's 1/w at q, Σ
/// α_i(q)/w_i with the weights α_i of placement_filter.h. As p lies in some placement, q is within
/// 2 reach/(1 − ρ) of a point of the exact triangle, where no α_i is negative. Σ ∂α_i = 0 and Σ
/// |∂α_i| = ρ/reach, so the negative α_i(q) sum up to at most N = ρ/(1 − ρ). So 1/w > 0 if N/(1 +
/// N) = ρ is less than the ratio of the least w to the greatest.
///
/// Otherwise, as in triangles of a few grid units, the enclosure holds all depths between the
/// vertices' depths, and the exact triangle's own depth, which Basis::unspecified permits.
class DepthFilter {
 public:
  /// `coverage` must be the triangle's filter; at() must be called only for samples in its box.
  DepthFilter(const TriangleSetup& triangle, const TriangleFilter& coverage);

  /// Empty if doubles cannot enclose the depth; the caller must then compute the exact depth.
  std::optional<records::Enclosure> at(int x, int y, const cases::SamplePosition& sample) const;

 private:
  void set_line(const TriangleSetup& triangle, const ProjectiveMap& map, double moved);

  PixelBox box_;
  std::optional<FilterLine> line_;  ///< |det M| times the depth
  double reciprocal_ = 0;           ///< 1 / |det M|
  double radius_ = 0;
  records::Enclosure range_;         ///< the rules clamp depths to this
  records::Enclosure offset_{0, 0};  ///< of a depth bias; infinite if nothing bounds it
  /// The vertices' depths, if all depths between them are permitted.
  std::optional<records::Enclosure> vertices_;
};

}  // namespace rastercheck::oracle
