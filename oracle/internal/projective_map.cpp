#include "oracle/internal/projective_map.h"

namespace rastercheck::oracle {

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

ProjectiveMap ProjectiveMap::of_line(const RingVector3& a, const RingVector3& b,
                                     bool along_an_axis) {
  const std::array<Ring, 2> direction = direction_of(a, b);
  std::array<Ring, 2> n = direction;
  if (along_an_axis) n[1 - major_axis(direction)] = Ring(0);
  const auto functional = [&n](const RingVector3& k) {
    return Line{n[0] * k[2], n[1] * k[2], -(n[0] * k[0] + n[1] * k[1])};
  };
  const Line at_b = functional(b);
  ProjectiveMap map;
  map.edges_ = {Line{-at_b.a, -at_b.b, -at_b.c}, functional(a), Line(Ring(0), Ring(0), Ring(0))};
  map.determinant_ = n[0] * direction[0] + n[1] * direction[1];
  map.orientation_ = sign_of(map.determinant_);
  return map;
}

ProjectiveMap ProjectiveMap::of_point(const RingVector3& column) {
  ProjectiveMap map;
  map.orientation_ = sign_of(column[2]);
  map.determinant_ = magnitude(column[2]);
  const Ring one(map.orientation_ < 0 ? -1 : 1);
  map.edges_ = {Line(Ring(0), Ring(0), one), Line(Ring(0), Ring(0), Ring(0)),
                Line(Ring(0), Ring(0), Ring(0))};
  return map;
}

std::array<Ring, 2> direction_of(const RingVector3& a, const RingVector3& b) {
  return {a[2] * b[0] - b[2] * a[0], a[2] * b[1] - b[2] * a[1]};
}

std::size_t major_axis(const std::array<Ring, 2>& direction) {
  return magnitude(direction[0]) < magnitude(direction[1]) ? 1 : 0;
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

}  // namespace rastercheck::oracle
