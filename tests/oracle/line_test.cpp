// The side of a line on which a point lies, as decided by doubles: never wrong, and seldom
// undecided.

#include "oracle/internal/line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rastercheck::oracle::line_test {
namespace {

Line line(int a, int b, int c) { return {Ring(a), Ring(b), Ring(c)}; }
Point point(double u, double v) { return {Ring(u), Ring(v)}; }

TEST(Line, IsOnOneSideFarFromItself) {
  const Line f = line(3, -2, 5);
  EXPECT_EQ(f.certain_side(near_point(point(1, 1))), 1);
  EXPECT_EQ(f.certain_side(near_point(point(-3, 1))), -1);
  EXPECT_EQ(f.certain_side(near_point(point(-1, 1))), 0);  // on the line
  EXPECT_EQ(f.certain_side(near_point(HomogeneousPoint(Ring(2), Ring(2), Ring(2)))), 1);
}

// The value is 6 at (1, 1), and a step of r along both axes changes it by 5 r.
TEST(Line, StaysOnOneSideWithinReach) {
  const Line f = line(3, -2, 5);
  EXPECT_EQ(f.certain_side(near_point(point(1, 1)), 1.0), 1);
  EXPECT_EQ(f.certain_side(near_point(point(1, 1)), 1.25), 0);
  EXPECT_EQ(line(-3, 2, -5).certain_side(near_point(point(1, 1)), 1.0), -1);
  EXPECT_EQ(line(-3, 2, -5).certain_side(near_point(point(1, 1)), 1.25), 0);
}

// Kills: an answer computed from coefficients that doubles cannot approximate.
TEST(Line, OfCoefficientsThatNoDoubleHoldsIsLeftToExactNumbers) {
  Ring tiny(0x1p-1000);
  tiny = tiny * tiny;
  const Line small(tiny, Ring(0), -tiny);
  EXPECT_EQ(small.certain_side(near_point(point(3, 0))), 0);
  EXPECT_EQ(small.sign_at(point(3, 0)), 1);
  EXPECT_EQ(small.sign_at(point(-3, 0)), -1);
  const Line far = line(1, 0, 0);
  const Point p{tiny, Ring(0)};
  EXPECT_EQ(far.certain_side(near_point(p)), 0);
  EXPECT_EQ(far.sign_at(p), 1);
  Ring huge(0x1p1000);
  huge = huge * huge;
  const Line large(huge, Ring(0), -huge);
  EXPECT_EQ(large.certain_side(near_point(point(3, 0))), 0);
  EXPECT_EQ(large.sign_at(point(3, 0)), 1);
}

// The two terms are 3/2 and a little more than 3/2, times ±2^-1074, the smallest double. In doubles
// the first term is rounded to 2 · 2^-1074 and the second to 1 · 2^-1074, because the coefficient
// loses 2^-54 and the rest is less than 3/2. Kills: quotients that are trusted because their
// operands are.
TEST(Line, AtAPointThatIsTooNearForProductsIsLeftToExactNumbers) {
  const Ring scale(0x1p-479);
  const Line f(scale, scale * -(Ring(1.25) + Ring(0x1p-54)), Ring(0));
  const HomogeneousPoint p(Ring(1.5 * 0x1p-125), Ring(1.2 * 0x1p-125), Ring(0x1p470));
  EXPECT_EQ(sign_of(f.at(p)), -1);
  EXPECT_EQ(f.certain_side(near_point(p)), 0);
}

// Lines with many bits whose value at a point is ±2^-k times the size of their terms, with k from 0
// to 69.
TEST(Line, IsNeverOnTheWrongSide) {
  std::mt19937_64 engine(1);
  const auto random = [&engine] {
    return Ring(std::ldexp(static_cast<double>(engine() >> 11U), -40)) *
               Ring(static_cast<double>(engine() >> 11U)) -
           Ring(static_cast<double>(engine() >> 20U));
  };
  int certain = 0;
  int open = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point p = point(static_cast<double>(engine() % 65536) / 16,
                          static_cast<double>(engine() % 65536) / 256);
    const Ring a = random();
    const Ring b = -random();
    const double size = std::abs(near_double(a * p.u)) + std::abs(near_double(b * p.v));
    const Ring off(std::ldexp(size, -static_cast<int>(engine() % 70)));
    const bool is_below = engine() % 2 == 0;
    const Line f(a, b, (is_below ? -off : off) - a * p.u - b * p.v);
    const int sign = sign_of(f.at(p));
    EXPECT_EQ(f.sign_at(p), sign);

    const double reach = std::ldexp(1.0, -static_cast<int>(engine() % 40));
    const Ring change = Ring(reach) * (magnitude(a) + magnitude(b));
    for (const bool is_moved : {false, true}) {
      const int side = f.certain_side(near_point(p), is_moved ? reach : 0);
      ++(side == 0 ? open : certain);
      if (side == 0) continue;
      EXPECT_EQ(side, sign);
      if (is_moved) {
        EXPECT_GT(magnitude(f.at(p)), change);
      }
    }
  }
  EXPECT_GT(certain, 15000);
  EXPECT_GT(open, 10000);
}

}  // namespace
}  // namespace rastercheck::oracle::line_test
