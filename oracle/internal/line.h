#pragma once

// Lines in window space as affine functionals, and the points that they are asked at. Which side of
// a line a point is on doubles mostly tell for certain; else exact numbers do.

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

/// Which way one turns at b on the way from a to b to p: the sign of (b − a) × (p − a). a and b are
/// points of a subpixel grid, with coordinates of at most 32 bits; `near` is near_point(p).
int turn_of(const std::array<double, 2>& a, const std::array<double, 2>& b, const Point& p,
            const NearPoint& near);

/// How much a line changes where a point moves by `reach` along both axes.
Ring band_of(const Line& line, const Ring& reach);

}  // namespace rastercheck::oracle
