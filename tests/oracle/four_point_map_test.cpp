#include "tests/oracle/four_point_map.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <array>
#include <optional>
#include <string>

#include "oracle/internal/rational_number.h"
#include "tests/oracle/random_case.h"

namespace rastercheck::oracle::four_point_map_test {
namespace {

using Side = FourPointError::Side;

PlanePoint point(double x, double y, double t = 1) {
  return {Rational(x), Rational(y), Rational(t)};
}

const FourPoints kSquare{point(0, 0), point(1, 0), point(1, 1), point(0, 1)};

FourPointMap map_of(const FourPoints& from, const FourPoints& to) {
  return FourPointMap::infer(from, to).value();
}

/// The image as "x y", or "infinite".
std::string text_at(const FourPointMap& map, double x, double y) {
  const auto image = map.at(x, y);
  if (!image) return "infinite";
  return (*image)[0].to_string() + " " + (*image)[1].to_string();
}

std::string text_of(const FourPointMap& map) {
  std::string text;
  for (const auto& row : map.matrix()) {
    for (const Rational& number : row) text += number.to_string() + " ";
    text.back() = ';';
  }
  return text;
}

TEST(FourPointMap, OfPointsToThemselvesIsTheIdentity) {
  EXPECT_EQ(text_of(map_of(kSquare, kSquare)), "1 0 0;0 1 0;0 0 1;");
  const FourPoints others{point(3, -1), point(0, 7), point(2, 2, 5), point(1, 4, 0)};
  EXPECT_EQ(text_of(map_of(others, others)), "1 0 0;0 1 0;0 0 1;");
}

// Heckbert's closed form for the map of the unit square to (0,0), (4,0), (3,2), (1,2): the corners'
// differences are Σ = (−2, 0), Δ1 = (1, −2), Δ2 = (−2, 0), so that det(Δ1, Δ2) = −4, g = 0/−4 = 0,
// h = det(Δ1, Σ)/−4 = 1, and
//   x = ((4 − 0) s + (1 + 1) t)/(t + 1),   y = (2 + 2) t/(t + 1).
// The square's diagonals meet in (1/2, 1/2), the trapezoid's in (2, 4/3).
TEST(FourPointMap, OfTheSquareToATrapezoid) {
  const FourPointMap map = map_of(kSquare, {point(0, 0), point(4, 0), point(3, 2), point(1, 2)});
  EXPECT_EQ(text_of(map), "4 2 0;0 4 0;0 1 1;");
  EXPECT_EQ(text_at(map, 0.5, 0.5), "2 4/3");
  EXPECT_EQ(text_at(map, 1, 1), "3 2");
  EXPECT_EQ(text_at(map, 0.25, 3), "7/4 3");
  EXPECT_EQ(text_at(map, 5, -1), "infinite");
}

// A turn by the larger angle of the triangle 3-4-5: (3x − 4y, 4x + 3y)/5.
TEST(FourPointMap, OfATurn) {
  const FourPointMap map = map_of({point(0, 0), point(5, 0), point(5, 5), point(0, 5)},
                                  {point(0, 0), point(3, 4), point(-1, 7), point(-4, 3)});
  EXPECT_EQ(text_of(map), "3/5 -4/5 0;4/5 3/5 0;0 0 1;");
  EXPECT_EQ(text_at(map, 10, 5), "2 11");
}

// The points at infinity of both axes, the origin and (1, 1) are mapped to (1, 0), (0, 1), the
// origin and (1/3, 1/3), by x/(x + y + 1) and y/(x + y + 1).
TEST(FourPointMap, TakesPointsAtInfinity) {
  const FourPointMap map = map_of({point(1, 0, 0), point(0, 1, 0), point(0, 0), point(1, 1)},
                                  {point(1, 0), point(0, 1), point(0, 0), point(1, 1, 3)});
  EXPECT_EQ(text_of(map), "1 0 0;0 1 0;1 1 1;");
  EXPECT_EQ(text_at(map, 2, 1), "1/2 1/4");
  EXPECT_EQ(text_at(map, -3, 2), "infinite");
}

// Kills: a point's own factor treated as part of the map.
TEST(FourPointMap, DoesNotDependOnFactorsOfPoints) {
  const FourPoints to{point(0, 0), point(4, 0), point(3, 2), point(1, 2)};
  const FourPointMap scaled =
      map_of({point(0, 0, -7), point(3, 0, 3), point(-2, -2, -2), kSquare[3]},
             {to[0], point(20, 0, 5), point(1.5, 1, 0.5), to[3]});
  EXPECT_EQ(text_at(scaled, 0.5, 0.5), "2 4/3");
  EXPECT_EQ(text_at(scaled, 0.25, 3), "7/4 3");
}

// The matrix takes the first point of one side to the first of the other exactly as given. For a
// quad (x, y, w) with parameters (u, v, 1), the last number of each image is the corner's w_r, if
// that of the first corner is 1.
TEST(FourPointMap, KeepsTheFirstPointsFactor) {
  const FourPointMap map =
      map_of({point(0, 0, 2), point(3, 0, 3), point(2, 2, 2), point(0, 1)}, kSquare);
  const PlanePoint first = map.at(point(0, 0, 2));
  EXPECT_EQ(first.x.to_string() + " " + first.y.to_string() + " " + first.t.to_string(), "0 0 1");
}

TEST(FourPointMap, SaysWhichPointsLieOnALine) {
  const auto error = [](const FourPoints& from, const FourPoints& to) {
    return FourPointMap::infer(from, to).error();
  };
  const FourPoints first{point(0, 0), point(1, 1), point(3, 3), point(0, 1)};
  EXPECT_EQ(error(first, kSquare), (FourPointError{Side::from, {0, 1, 2}}));
  EXPECT_EQ(error(kSquare, first), (FourPointError{Side::to, {0, 1, 2}}));
  EXPECT_EQ(error({first[0], first[1], first[3], first[2]}, kSquare),
            (FourPointError{Side::from, {0, 1, 3}}));
  EXPECT_EQ(error({first[0], first[3], first[1], first[2]}, kSquare),
            (FourPointError{Side::from, {0, 2, 3}}));
  EXPECT_EQ(error({first[3], first[0], first[1], first[2]}, kSquare),
            (FourPointError{Side::from, {1, 2, 3}}));
  // If both sides have points on a line, the first side is named.
  EXPECT_EQ(error({first[3], first[0], first[1], first[2]}, first).side, Side::from);
  // Two points that coincide, and a triple (0, 0, 0) that is not a point.
  EXPECT_EQ(error(kSquare, {kSquare[0], kSquare[1], kSquare[2], point(2, 2, 2)}),
            (FourPointError{Side::to, {0, 2, 3}}));
  EXPECT_EQ(error(kSquare, {point(0, 0, 0), kSquare[1], kSquare[2], kSquare[3]}),
            (FourPointError{Side::to, {0, 1, 2}}));
}

FourPoints random_points() {
  FourPoints points;
  for (PlanePoint& p : points) {
    const float x = random_float(8);
    const float y = random_float(8);
    p = point(x, y);
  }
  return points;
}

/// The map's matrix with 1 as its last number, from x' (g x + h y + 1) = a x + b y + c and the same
/// for y' at the four points: eight linear equations in a … h. Returns nullopt if they have no
/// unique solution.
std::optional<Eigen::Matrix<Field, 8, 1>> by_linear_equations(const FourPoints& from,
                                                              const FourPoints& to) {
  Eigen::Matrix<Field, 8, 8> a = Eigen::Matrix<Field, 8, 8>::Constant(Field(0));
  Eigen::Matrix<Field, 8, 1> right;
  for (std::size_t i = 0; i < 4; ++i) {
    const Field& x = to_field(from[i].x);
    const Field& y = to_field(from[i].y);
    const std::array<Field, 2> image{to_field(to[i].x), to_field(to[i].y)};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto row = static_cast<Eigen::Index>(2 * i + k);
      const auto column = static_cast<Eigen::Index>(3 * k);
      a(row, column) = x;
      a(row, column + 1) = y;
      a(row, column + 2) = Field(1);
      a(row, 6) = -image[k] * x;
      a(row, 7) = -image[k] * y;
      right[row] = image[k];
    }
  }
  const Eigen::PartialPivLU<Eigen::Matrix<Field, 8, 8>> solver(a);
  if (sign_of(Field(solver.determinant())) == 0) return std::nullopt;
  return solver.solve(right);
}

RC_GTEST_PROP(FourPointMap, IsTheSolutionOfEightLinearEquations, ()) {
  const FourPoints from = random_points();
  const FourPoints to = random_points();
  const auto map = FourPointMap::infer(from, to);
  const auto solved = by_linear_equations(from, to);
  if (!map) {
    RC_TAG("on a line");
    return;
  }
  const Field& last = to_field(map->matrix()[2][2]);
  RC_ASSERT(solved.has_value() == (sign_of(last) != 0));
  RC_PRE(solved.has_value());
  for (std::size_t i = 0; i < 8; ++i) {
    RC_ASSERT(to_field(map->matrix()[i / 3][i % 3]) / last ==
              (*solved)[static_cast<Eigen::Index>(i)]);
  }
}

RC_GTEST_PROP(FourPointMap, TakesEachPointToItsOwn, ()) {
  const FourPoints from = random_points();
  const FourPoints to = random_points();
  const auto map = FourPointMap::infer(from, to);
  RC_PRE(map.has_value());
  for (std::size_t i = 0; i < 4; ++i) {
    const PlanePoint image = map->at(from[i]);
    const Field& t = to_field(image.t);
    RC_ASSERT(sign_of(t) != 0);
    RC_ASSERT(to_field(image.x) / t == to_field(to[i].x));
    RC_ASSERT(to_field(image.y) / t == to_field(to[i].y));
  }
}

}  // namespace
}  // namespace rastercheck::oracle::four_point_map_test
