#include "oracle/internal/projective_map.h"

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
  // Quotients of such may be as far from 1 as 2^±960, which is too far: they are asked as well.
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

ProjectiveMap::ProjectiveMap(const std::array<RingVector3, 3>& columns) {
  // Row i of adj(M) is the cross product of the two other columns, in cyclic order.
  std::array<RingVector3, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) rows[i] = columns[(i + 1) % 3].cross(columns[(i + 2) % 3]);
  const Ring determinant = columns[0].dot(rows[0]);
  orientation_ = sign_of(determinant);
  determinant_ = magnitude(determinant);
  for (std::size_t i = 0; i < 3; ++i) {
    if (orientation_ < 0) rows[i] = -rows[i];
    edges_[i] = {rows[i][0], rows[i][1], rows[i][2]};
  }
}

const Line& ProjectiveMap::inverse_w() const {
  if (!inverse_w_) {
    const auto& [e, f, g] = edges_;
    inverse_w_ = Line{e.a + f.a + g.a, e.b + f.b + g.b, e.c + f.c + g.c};
  }
  return *inverse_w_;
}

Line ProjectiveMap::combine(const std::array<Ring, 3>& s) const {
  const auto& [e, f, g] = edges_;
  return {e.a * s[0] + f.a * s[1] + g.a * s[2], e.b * s[0] + f.b * s[1] + g.b * s[2],
          e.c * s[0] + f.c * s[1] + g.c * s[2]};
}

bool strictly_inside(const ProjectiveMap& map, const Point& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (map.edge(i).sign_at(p) <= 0) return false;
  }
  return map.orientation() != 0;
}

}  // namespace rastercheck::oracle
