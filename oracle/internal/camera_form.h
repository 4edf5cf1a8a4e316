#pragma once

// The q-matrix in camera form (Appendix 5, p. 7), solved by elimination in rationals.

#include <array>
#include <optional>

#include "oracle/internal/number.h"

namespace rastercheck::oracle {

using FieldVector3 = Eigen::Matrix<Field, 3, 1>;
using FieldMatrix3 = Eigen::Matrix<Field, 3, 3>;

/// An eye and an image plane. The ray through (u, v) has the direction c + u a + v b.
struct ImagePlane {
  FieldVector3 eye;
  FieldVector3 a;
  FieldVector3 b;
  FieldVector3 c;
};

/// Q = [V1−C V2−C V3−C]^-1 [a b c]; empty if the triangle's plane contains the eye.
std::optional<FieldMatrix3> q_matrix(const std::array<FieldVector3, 3>& vertices,
                                     const ImagePlane& plane);

}  // namespace rastercheck::oracle
