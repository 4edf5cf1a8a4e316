#pragma once

// The projective map of a triangle (RULES §1; Appendix 5, p. 7; Heckbert & Moreton 1991, §3.2).
//
//   M = columns (X_i, Y_i, w_i), window position times w, and w
//   E_i(u, v) = sign(det M) · row i of adj(M) · (u, v, 1)^T      = |det M| · e_i(u, v)
//
// Neither a sign nor a ratio of sums of E_i needs a division: with Q = M^-1 = adj(M)/det M, E
// differs from e = Q (u, v, 1)^T by the positive factor |det M|. So everything below stays in the
// ring and is exact.

#include <array>
#include <optional>

#include "oracle/internal/line.h"
#include "oracle/internal/number.h"

namespace rastercheck::oracle {

class ProjectiveMap {
 public:
  /// `columns[i]` = (X_i, Y_i, w_i).
  explicit ProjectiveMap(const std::array<RingVector3, 3>& columns);

  /// sign(det M): the orientation of the triangle in window space; 0 if it has none.
  int orientation() const { return orientation_; }
  /// E_i; positive on the inner side of the edge opposite vertex i. If the orientation is 0, all
  /// E_i are zero or parallel, and have the sign of adj(M).
  const Line& edge(std::size_t i) const { return edges_[i]; }
  /// |det M| = Σ E_i w_i, at every point.
  const Ring& determinant() const { return determinant_; }
  /// Σ E_i s_i: the functional that takes the value s_i |det M| / w_i at vertex i (w_i ≠ 0).
  Line combine(const std::array<Ring, 3>& s) const;
  /// Σ E_i: |det M| times 1/w (the D of RULES §1).
  const Line& inverse_w() const;

 private:
  std::array<Line, 3> edges_;
  mutable std::optional<Line> inverse_w_;  ///< made when first asked for
  Ring determinant_;
  int orientation_;
};

}  // namespace rastercheck::oracle
