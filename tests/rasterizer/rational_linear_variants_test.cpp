// rational-linear and the methods that differ from it in a step: what they cost.

#include <gtest/gtest.h>

#include "rasterizer/methods/method.h"

namespace rastercheck::rasterizer {
namespace {

OperationCounts operations_of(const char* name) { return find_method(name)->operations(); }

// Seed 002 §4: n + 1 divisions per vertex, none per polygon, n divisions per pixel. By hand: three
// parameters; the weights of a place take three differences, a mean of two ends two products, a sum
// and a division.
TEST(RationalLinearOperations, AreThoseOfThePaperAndOfTheMeans) {
  const OperationCounts counts = operations_of("rational-linear");
  EXPECT_EQ(counts.per_polygon, (Operations{0, 0, 0}));
  EXPECT_EQ(counts.per_vertex, (Operations{0, 0, 3}));
  EXPECT_EQ(counts.per_row, (Operations{2 * (3 + 3), 2 * 6, 2 * 3}));
  EXPECT_EQ(counts.per_pixel, (Operations{3 + 3, 6, 3 + 2}));
}

}  // namespace
}  // namespace rastercheck::rasterizer
