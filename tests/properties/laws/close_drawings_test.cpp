// How far apart two numbers may be of which each may be as far from the same one.

#include "properties/laws/internal/close_drawings.h"

#include <gtest/gtest.h>

namespace rastercheck::properties::close_drawings_test {
namespace {

TEST(Closeness, IsOfTheGreatestNumbersUlp) {
  EXPECT_EQ(greatest_difference({1.02, 8}, 3, -2), 1.02 * 0x1p-20);
  // Just below 16 what both are computed of may lie above.
  EXPECT_EQ(greatest_difference({1.02, 8}, 0x1.fffffep3, 0), 1.02 * 0x1p-19);
}

}  // namespace
}  // namespace rastercheck::properties::close_drawings_test
