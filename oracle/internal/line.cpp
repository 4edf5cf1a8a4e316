#include "oracle/internal/line.h"

#include <cmath>

namespace rastercheck::oracle {

NearPoint near_point(const Point& p) {
  const double u = near_double(p.u);
  const double v = near_double(p.v);
  return {u, v, has_normal_products(u, p.u) && has_normal_products(v, p.v)};
}

NearPoint near_point(const HomogeneousPoint& p) {
  const double u = near_double(p.u);
  const double v = near_double(p.v);
  const double t = near_double(p.t);
  NearPoint near{u / t, v / t};
  // The quotients may be as large or small as 2^±960, which is beyond the limits, so they are
  // tested as well.
  near.has_normal_products = has_normal_products(u, p.u) && has_normal_products(v, p.v) &&
                             has_normal_products(t, p.t) && has_normal_products(near.u, p.u) &&
                             has_normal_products(near.v, p.v);
  return near;
}

int Line::certain_side(const NearPoint& p, double reach) const {
  if (!near_) {
    near_ = Near{near_double(a), near_double(b), near_double(c), false};
    near_->has_normal_products = oracle::has_normal_products(near_->a, a) &&
                                 oracle::has_normal_products(near_->b, b) &&
                                 oracle::has_normal_products(near_->c, c);
  }
  if (!near_->has_normal_products || !p.has_normal_products) return 0;
  const double along_u = near_->a * p.u;
  const double along_v = near_->b * p.v;
  const double value = along_u + along_v + near_->c;
  const double sizes = std::abs(along_u) + std::abs(along_v) + std::abs(near_->c);
  const double change = reach * (std::abs(near_->a) + std::abs(near_->b));
  if (!(std::abs(value) > change + (sizes + change) * 0x1p-47)) return 0;
  return value < 0 ? -1 : 1;
}

int Line::sign_at(const Point& p) const {
  const int side = certain_side(near_point(p));
  return side != 0 ? side : sign_of(at(p));
}

int turn_of(const std::array<double, 2>& a, const std::array<double, 2>& b, const Point& p,
            const NearPoint& near) {
  const double along_x = b[0] - a[0];  // exact: differences of numbers on one grid
  const double along_y = b[1] - a[1];
  const double to_x = near.u - a[0];
  const double to_y = near.v - a[1];
  const double turn = along_x * to_y - along_y * to_x;
  // u and v are off by at most 2^-51 relative, and four roundings add 2^-53 each.
  const double error = (std::abs(along_x) * (std::abs(near.v) + std::abs(to_y)) +
                        std::abs(along_y) * (std::abs(near.u) + std::abs(to_x))) *
                       0x1p-47;
  if (near.has_normal_products && std::abs(turn) > error) return turn < 0 ? -1 : 1;
  return sign_of(Ring(along_x) * (p.v - Ring(a[1])) - Ring(along_y) * (p.u - Ring(a[0])));
}

Ring band_of(const Line& line, const Ring& reach) {
  return reach * (magnitude(line.a) + magnitude(line.b));
}

}  // namespace rastercheck::oracle
