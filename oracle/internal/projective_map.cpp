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
