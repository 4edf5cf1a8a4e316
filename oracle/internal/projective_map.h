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

  /// The map of a line from a to b, whose values are constant across it (RULES §10). The share of b
  /// in a value at p is s, where p lies, in the direction n, between a (s = 0) and b (s = 1). With
  /// g_k = n·(p w_k − (X, Y)_k),
  ///
  ///   E_0 = −g_b,   E_1 = g_a,   E_2 = 0,   |det M| = n·(w_a (X, Y)_b − w_b (X, Y)_a)
  ///
  /// so that values and 1/w are the same sums of E_i as a triangle's. n is the direction of the
  /// line or, if `along_an_axis`, its part along the major axis (major_axis()). The orientation is
  /// 1, and 0 if a and b are one point of the window.
  static ProjectiveMap of_line(const RingVector3& a, const RingVector3& b, bool along_an_axis);

  /// The map of a point: E_0 is constant, and all values are the vertex's. The orientation is the
  /// sign of w.
  static ProjectiveMap of_point(const RingVector3& column);

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
  ProjectiveMap() = default;

  std::array<Line, 3> edges_;
  mutable std::optional<Line> inverse_w_;  ///< made when first asked for
  Ring determinant_;
  int orientation_ = 0;
};

/// w_a (X, Y)_b − w_b (X, Y)_a: the direction of a line, times w_a w_b.
std::array<Ring, 2> direction_of(const RingVector3& a, const RingVector3& b);
/// The axis along which a direction is longer: 0 (x, also if equal) or 1.
std::size_t major_axis(const std::array<Ring, 2>& direction);

}  // namespace rastercheck::oracle
