#pragma once

// Lines in window space as affine functionals, and the points they are evaluated at. Mostly,
// doubles decide on which side of a line a point lies; if they cannot, exact numbers do.

#include <array>
#include <optional>
#include <utility>

#include "oracle/internal/number.h"

namespace rastercheck::oracle {

/// A window position in pixels, with dyadic coordinates, as all samples have.
struct Point {
  Ring u;
  Ring v;
};

/// The window position (u/t, v/t) in pixels, t > 0, for points that need not be dyadic, such as a
/// polygon's corners.
struct HomogeneousPoint {
  HomogeneousPoint() = default;
  HomogeneousPoint(Ring u_, Ring v_, Ring t_)
      : u(std::move(u_)), v(std::move(v_)), t(std::move(t_)) {}

  Ring u;
  Ring v;
  Ring t;
};

/// A window position in doubles. Each coordinate has a relative error of at most 2^-48 if
/// has_normal_products is true (number.h).
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
  /// t times the value at p.
  Ring at(const HomogeneousPoint& p) const { return a * p.u + b * p.v + c * p.t; }
  bool is_constant() const { return sign_of(a) == 0 && sign_of(b) == 0; }

  /// The sign of at(p); computed in doubles unless too close to zero.
  int sign_at(const Point& p) const;
  /// 1 if doubles prove the value positive for every move of p by up to `reach` pixels along each
  /// axis; −1 if they prove it negative; else 0. `reach` must be a double, possibly one made by
  /// near_double().                                                        (proofs/side.g)
  int certain_side(const NearPoint& p, double reach = 0) const;

 private:
  struct Near {
    double a = 0;
    double b = 0;
    double c = 0;
    bool has_normal_products = false;
  };
  mutable std::optional<Near> near_;  ///< made when first asked for; a, b and c must not change
                                      ///< afterwards
};

/// The sign of (b − a) × (p − a): the direction of the turn at b on the way from a to b to p. a and
/// b must be points of a subpixel grid, with coordinates of at most 32 bits; `near` must be
/// near_point(p).
int turn_of(const std::array<double, 2>& a, const std::array<double, 2>& b, const Point& p,
            const NearPoint& near);

/// The largest change of a line's value when a point moves by up to `reach` along both axes.
Ring band_of(const Line& line, const Ring& reach);

}  // namespace rastercheck::oracle
