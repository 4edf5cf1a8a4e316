// Intervals of painted values hold what float32 makes of them.

#include "oracle/internal/painting.h"

#include <gtest/gtest.h>

namespace rastercheck::oracle::painting_test {
namespace {

// The float next to 0.1 is 0x1.99999ap-4, above it, and the float next to 0.3 is 0x1.333334p-2,
// above it too; of their negatives both are below.
TEST(ProductOf, ReachesTheNearestFloats) {
  const ValueSpan above = product_of({0.1, 0.3, false}, exactly(1));
  EXPECT_LE(above.lo, 0.1);
  EXPECT_GE(above.hi, 0x1.333334p-2);
  const ValueSpan below = product_of({0.1, 0.3, false}, exactly(-1));
  EXPECT_LE(below.lo, -0x1.333334p-2);
  EXPECT_GE(below.hi, -0.1);
}

}  // namespace
}  // namespace rastercheck::oracle::painting_test
