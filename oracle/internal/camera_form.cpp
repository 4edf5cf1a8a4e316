#include "oracle/internal/camera_form.h"

#include <Eigen/LU>

namespace rastercheck::oracle {

std::optional<FieldMatrix3> q_matrix(const std::array<FieldVector3, 3>& vertices,
                                     const ImagePlane& plane) {
  FieldMatrix3 m;
  for (std::size_t i = 0; i < 3; ++i) m.col(static_cast<Eigen::Index>(i)) = vertices[i] - plane.eye;
  FieldMatrix3 abc;
  abc.col(0) = plane.a;
  abc.col(1) = plane.b;
  abc.col(2) = plane.c;
  // Gaussian elimination with exact pivots finds the exact rank.
  const Eigen::FullPivLU<FieldMatrix3> lu(m);
  if (!lu.isInvertible()) return std::nullopt;
  return FieldMatrix3(lu.solve(abc));
}

}  // namespace rastercheck::oracle
