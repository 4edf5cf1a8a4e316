// The largest difference of two numbers that are each within the same bound of one exact number.

#include "properties/laws/internal/close_drawings.h"

#include <gtest/gtest.h>

namespace rastercheck::properties::close_drawings_test {
namespace {

TEST(Closeness, IsOfTheGreatestNumbersUlp) {
  EXPECT_EQ(greatest_difference({1.02, 8}, 3, -2), 1.02 * 0x1p-20);
  // For values just below 16, the exact value may lie above 16.
  EXPECT_EQ(greatest_difference({1.02, 8}, 0x1.fffffep3, 0), 1.02 * 0x1p-19);
}

}  // namespace
}  // namespace rastercheck::properties::close_drawings_test
