#include "oracle/internal/convex_region.h"

#include <gtest/gtest.h>

namespace rastercheck::oracle {
namespace {

Line line(int a, int b, int c) { return {Ring(a), Ring(b), Ring(c)}; }

/// Twice the area, by the shoelace formula.
Field twice_area(const ConvexRegion& region) {
  Field sum(0);
  const auto& v = region.vertices();
  for (std::size_t i = 0; i < v.size(); ++i) {
    const FieldPoint& p = v[i];
    const FieldPoint& q = v[(i + 1) % v.size()];
    sum += p.u * q.v - q.u * p.v;
  }
  return sum;
}

ConvexRegion unit_square() { return {FieldPoint{0, 0}, FieldPoint{1, 1}}; }

TEST(ConvexRegion, KeepsWhatLiesInTheHalfPlane) {
  ConvexRegion region = unit_square();
  region.clip(line(-2, -2, 1));  // u + v <= 1/2
  EXPECT_EQ(region.vertices().size(), 3U);
  EXPECT_EQ(twice_area(region), Field(1, 4));
}

TEST(ConvexRegion, IsClosed) {
  ConvexRegion region = unit_square();
  region.clip(line(1, 0, -1));  // u >= 1: the right side stays
  EXPECT_FALSE(region.is_empty());
  EXPECT_EQ(twice_area(region), Field(0));
  region.clip(line(0, -1, 0));  // v <= 0: its lower corner stays
  ASSERT_FALSE(region.is_empty());
  for (const FieldPoint& p : region.vertices()) {
    EXPECT_EQ(p.u, Field(1));
    EXPECT_EQ(p.v, Field(0));
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
  region.clip_above(line(3, 0, 0), Field(1));  // u >= 1/3
  EXPECT_EQ(twice_area(region), Field(4, 3));
}

}  // namespace
}  // namespace rastercheck::oracle
