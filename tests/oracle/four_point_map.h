#pragma once

// The projective map of the plane that takes four points to four others, exactly (P. S. Heckbert,
// Fundamentals of Texture Mapping and Image Warping, 1989, which seed 002 §3.4 names for warps that
// have to be inferred).
//
// Let the fourth of the points p, as homogeneous columns, be p_3 = α_0 p_0 + α_1 p_1 + α_2 p_2, and
// q_3 alike with β. A matrix that takes p_i to a multiple of q_i, i = 0, 1, 2, has these multiples
// free, and takes p_3 to a multiple of q_3 just where they are β_i/α_i but for a common factor:
//
//   H = Σ (β_i/α_i) q_i P_i,     P_i (the row p_j × p_k / det(p_0, p_1, p_2)) · p_m = 1 of m = i.
//
// No α_i or β_i is 0 where no three points of a side lie on a line. Convexity is not asked for: a
// pole may run between the points.

#include <array>
#include <cstddef>
#include <optional>
#include <tl/expected.hpp>

#include "oracle/rational.h"

namespace rastercheck::oracle {

/// The point (x/t, y/t); with t = 0 the one at infinity in the direction (x, y).
struct PlanePoint {
  Rational x;
  Rational y;
  Rational t = Rational(1);
};

/// (x/t, y/t); nothing at infinity.
std::optional<std::array<Rational, 2>> position_of(const PlanePoint& p);

using FourPoints = std::array<PlanePoint, 4>;

/// Why there is no map: three points of a side, in ascending order, that lie on a line. Two that
/// coincide do so with any other, and so does (0, 0, 0), which is no point.
struct FourPointError {
  enum class Side { from, to };
  Side side = Side::from;
  std::array<std::size_t, 3> points{};
  bool operator==(const FourPointError&) const = default;
};

class FourPointMap {
 public:
  /// An error names the first three of the first side.
  static tl::expected<FourPointMap, FourPointError> infer(const FourPoints& from,
                                                          const FourPoints& to);

  /// [row][column], of columns (x, y, t). The map leaves a factor open; with this one the matrix
  /// takes from[0] to to[0] as they were given, t included.
  const std::array<std::array<Rational, 3>, 3>& matrix() const { return matrix_; }

  /// The matrix times (x, y, t).
  PlanePoint at(const PlanePoint& p) const;
  /// The position of the image of (x, y), which are finite.
  std::optional<std::array<Rational, 2>> at(double x, double y) const;

 private:
  FourPointMap() = default;

  std::array<std::array<Rational, 3>, 3> matrix_;
};

}  // namespace rastercheck::oracle
