#pragma once

// The projective map of a triangle (RULES §1; seed 001 p. 7, seed 002 §3.2).
//
//   M = columns (X_i, Y_i, w_i), window position times w, and w
//   E_i(u, v) = sign(det M) · row i of adj(M) · (u, v, 1)^T      = |det M| · e_i(u, v)
//
// Dividing is never needed for a sign or for a ratio of sums of E_i: with Q = M^-1 = adj(M)/det M,
// E differs from e = Q (u, v, 1)^T by the positive factor |det M|. So everything below stays in the
// ring and is exact.

#include <array>
#include <optional>
#include <utility>

#include "oracle/internal/number.h"

namespace rastercheck::oracle {

/// A window position in pixels; dyadic, as all samples are.
struct Point {
  Ring u;
  Ring v;
};

/// The window position (u/t, v/t) in pixels, t > 0: one that need not be dyadic, such as a
/// polygon's corner.
struct HomogeneousPoint {
  HomogeneousPoint() = default;
  HomogeneousPoint(Ring u_, Ring v_, Ring t_)
      : u(std::move(u_)), v(std::move(v_)), t(std::move(t_)) {}

  Ring u;
  Ring v;
  Ring t;
};

/// A window position in doubles, each within 2^-48 of itself if they have normal products
/// (number.h).
struct NearPoint {
  double u = 0;
  double v = 0;
  bool has_normal_products = false;
};
NearPoint near_point(const Point& p);
NearPoint near_point(const HomogeneousPoint& p);

/// The affine functional a·u + b·v + c of window positions in pixels.
class Line {
 public:
  Line() = default;
  Line(Ring a_, Ring b_, Ring c_) : a(std::move(a_)), b(std::move(b_)), c(std::move(c_)) {}

  Ring a;
  Ring b;
  Ring c;

  Ring at(const Point& p) const { return a * p.u + b * p.v + c; }
  /// t times the value there.
  Ring at(const HomogeneousPoint& p) const { return a * p.u + b * p.v + c * p.t; }
  bool is_constant() const { return sign_of(a) == 0 && sign_of(b) == 0; }

  /// The sign of at(p): by doubles where it is far from zero, as nearly everywhere.
  int sign_at(const Point& p) const;
  /// 1 where doubles are sure that the value is positive however far p is moved along both axes, up
  /// to `reach` pixels; −1 where that it is negative; and 0 where they are not. `reach` is a double
  /// that near_double() may have made.                                         (proofs/side.g)
  int certain_side(const NearPoint& p, double reach = 0) const;

 private:
  struct Near {
    double a = 0;
    double b = 0;
    double c = 0;
    bool has_normal_products = false;
  };
  mutable std::optional<Near> near_;  ///< made when first asked for; a, b and c then stay
};

class ProjectiveMap {
 public:
  /// `columns[i]` = (X_i, Y_i, w_i).
  explicit ProjectiveMap(const std::array<RingVector3, 3>& columns);

  /// sign(det M): the orientation of the triangle in window space, 0 where it has none.
  int orientation() const { return orientation_; }
  /// E_i; positive on the inner side of the edge opposite vertex i. All zero or parallel where the
  /// orientation is 0; then the sign is that of adj(M).
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

/// The three conditions of a point inside the triangle, without ties.
bool strictly_inside(const ProjectiveMap& map, const Point& p);

}  // namespace rastercheck::oracle
