#pragma once

// The projective map of the plane that takes four points to four others, exactly (P. S. Heckbert,
// Fundamentals of Texture Mapping and Image Warping, 1989, which Heckbert & Moreton 1991, §3.4
// cites for warps that have to be inferred).
//
// Write the points as homogeneous columns. Let p_3 = α_0 p_0 + α_1 p_1 + α_2 p_2, and likewise q_3
// with β. A matrix that takes p_i to a multiple of q_i for i = 0, 1, 2 may choose these three
// multiples. It also takes p_3 to a multiple of q_3 exactly if the multiples are β_i/α_i, up to a
// common factor:
//
//   H = Σ (β_i/α_i) q_i P_i,     P_i = the row p_j × p_k / det(p_0, p_1, p_2)
//
// so that P_i p_m is 1 for m = i and 0 otherwise.
//
// No α_i or β_i is 0 if no three points of a side lie on a line. The points need not be convex: a
// pole may run between them.

#include <array>
#include <cstddef>
#include <optional>
#include <tl/expected.hpp>

#include "oracle/rational.h"

namespace rastercheck::oracle {

/// The point (x/t, y/t); with t = 0, the point at infinity in the direction (x, y).
struct PlanePoint {
  Rational x;
  Rational y;
  Rational t = Rational(1);
};

/// (x/t, y/t); nullopt for a point at infinity.
std::optional<std::array<Rational, 2>> position_of(const PlanePoint& p);

using FourPoints = std::array<PlanePoint, 4>;

/// Why the map does not exist: three points of a side, in ascending order, that lie on a line. Two
/// points that coincide lie on a line with any third point, and so does (0, 0, 0), which is not a
/// point.
struct FourPointError {
  enum class Side { from, to };
  Side side = Side::from;
  std::array<std::size_t, 3> points{};
  bool operator==(const FourPointError&) const = default;
};

class FourPointMap {
 public:
  /// Fails if three points of a side lie on a line. The error names the first three such points, on
  /// the first side that has any.
  static tl::expected<FourPointMap, FourPointError> infer(const FourPoints& from,
                                                          const FourPoints& to);

  /// [row][column], for columns (x, y, t). The map determines the matrix up to a factor; this
  /// matrix takes from[0] to to[0] exactly as given, including t.
  const std::array<std::array<Rational, 3>, 3>& matrix() const { return matrix_; }

  /// The matrix times (x, y, t).
  PlanePoint at(const PlanePoint& p) const;
  /// The position of the image of (x, y), which must be finite.
  std::optional<std::array<Rational, 2>> at(double x, double y) const;

 private:
  FourPointMap() = default;

  std::array<std::array<Rational, 3>, 3> matrix_;
};

}  // namespace rastercheck::oracle
