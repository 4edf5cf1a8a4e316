#include "oracle/internal/convex_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace rastercheck::oracle::convex_region_test {
namespace {

Line line(int a, int b, int c) { return {Ring(a), Ring(b), Ring(c)}; }

/// Twice the area, by the shoelace formula.
Field twice_area(const ConvexRegion& region) {
  Field sum(0);
  for (std::size_t i = 0; i < region.size(); ++i) {
    const HomogeneousPoint& p = region.vertex(i);
    const HomogeneousPoint& q = region.vertex((i + 1) % region.size());
    sum += quotient(p.u * q.v - q.u * p.v, p.t * q.t);
  }
  return sum;
}

ConvexRegion unit_square() { return {Point{Ring(0), Ring(0)}, Point{Ring(1), Ring(1)}}; }

TEST(ConvexRegion, KeepsWhatLiesInTheHalfPlane) {
  ConvexRegion region = unit_square();
  region.clip(line(-2, -2, 1));  // u + v <= 1/2
  EXPECT_EQ(region.size(), 3U);
  EXPECT_EQ(twice_area(region), Field(1, 4));
}

TEST(ConvexRegion, IsClosed) {
  ConvexRegion region = unit_square();
  region.clip(line(1, 0, -1));  // u >= 1: the right side stays
  EXPECT_FALSE(region.is_empty());
  EXPECT_EQ(twice_area(region), Field(0));
  region.clip(line(0, -1, 0));  // v <= 0: its lower corner stays
  ASSERT_FALSE(region.is_empty());
  for (std::size_t i = 0; i < region.size(); ++i) {
    const HomogeneousPoint& p = region.vertex(i);
    EXPECT_EQ(quotient(p.u, p.t), Field(1));
    EXPECT_EQ(quotient(p.v, p.t), Field(0));
  }
}

TEST(ConvexRegion, IsEmptyBeyondALine) {
  ConvexRegion region = unit_square();
  region.clip(line(1, 1, -3));
  EXPECT_TRUE(region.is_empty());
  region.clip(line(1, 0, 0));
  EXPECT_TRUE(region.is_empty());
}

TEST(ConvexRegion, IsCutAboveALevel) {
  ConvexRegion region = unit_square();
  region.clip_above(line(3, 0, 0), Ring(1));  // u >= 1/3
  EXPECT_EQ(twice_area(region), Field(4, 3));
}

/// The corners of the same polygon by definition, computed with divisions: the points where two of
/// the lines meet and that are not on the wrong side of any line. Sorted by coordinates.
std::vector<std::array<Field, 2>> corners_by_definition(const std::vector<Line>& lines) {
  std::vector<std::array<Field, 2>> corners;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const Line& f = lines[i];
      const Line& g = lines[j];
      const Ring det = f.a * g.b - f.b * g.a;
      if (sign_of(det) == 0) continue;
      const Field u = quotient(f.b * g.c - f.c * g.b, det);
      const Field v = quotient(f.c * g.a - f.a * g.c, det);
      const bool is_inside = std::all_of(lines.begin(), lines.end(), [&](const Line& line) {
        return Field(line.a) * u + Field(line.b) * v + Field(line.c) >= 0;
      });
      if (is_inside) corners.push_back({u, v});
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

// Kills: a side that is not kept with its corner; doubles that are trusted too far; a corner on a
// line that is dropped. Lines with small coefficients often meet in common corners. The scaled cuts
// are the same lines, but doubles cannot decide them.
TEST(ConvexRegion, HasTheCornersOfItsDefinition) {
  std::mt19937 engine(5);
  const auto integer = [&engine](int lo, int hi) {
    return lo + static_cast<int>(engine() % static_cast<unsigned>(hi - lo + 1));
  };
  for (int i = 0; i < 3000; ++i) {
    const Point lo{Ring(integer(-4, 0)), Ring(integer(-4, 0))};  // braces evaluate left to right
    const Point hi{Ring(integer(0, 4)), Ring(integer(0, 4))};
    std::vector<Line> lines{{Ring(1), Ring(0), -lo.u},
                            {Ring(-1), Ring(0), hi.u},
                            {Ring(0), Ring(1), -lo.v},
                            {Ring(0), Ring(-1), hi.v}};
    ConvexRegion region(lo, hi);
    const int cuts = integer(1, 6);
    for (int k = 0; k < cuts; ++k) {
      const Ring scale(integer(0, 3) == 0 ? 0x1p-600 : 1.0);
      const Line cut{scale * Ring(integer(-3, 3)), scale * Ring(integer(-3, 3)),
                     scale * Ring(integer(-3, 6))};
      lines.push_back(cut);
      region.clip(cut);
    }
    std::vector<std::array<Field, 2>> corners;
    for (std::size_t k = 0; k < region.size(); ++k) {
      const HomogeneousPoint& p = region.vertex(k);
      ASSERT_GT(sign_of(p.t), 0);
      corners.push_back({quotient(p.u, p.t), quotient(p.v, p.t)});
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    EXPECT_EQ(corners, corners_by_definition(lines)) << i;
  }
}

}  // namespace
}  // namespace rastercheck::oracle::convex_region_test
