#include "reports/image.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace rastercheck::reports::image_test {
namespace {

// Kills: exchanging columns and rows; channels in another order.
TEST(Image, IsRowByRowFromTheTop) {
  Image image = Image::filled(3, 2, {1, 2, 3});
  image.set(2, 0, {4, 5, 6});
  image.set(0, 1, {7, 8, 9});
  EXPECT_EQ(image.rgb, (std::vector<std::uint8_t>{1, 2, 3, 1, 2, 3, 4, 5, 6,  //
                                                  7, 8, 9, 1, 2, 3, 1, 2, 3}));
  EXPECT_EQ(image.at(2, 0), (Color{4, 5, 6}));
  EXPECT_EQ(image.at(0, 1), (Color{7, 8, 9}));
}

TEST(Image, NothingIsOutside) {
  Image image = Image::filled(2, 2, {0, 0, 0});
  for (const auto& [column, row] : {std::pair{-1, 0}, {2, 0}, {0, -1}, {0, 2}}) {
    image.set(column, row, {9, 9, 9});
  }
  EXPECT_EQ(image, Image::filled(2, 2, {0, 0, 0}));
  EXPECT_TRUE(Image::filled(0, 5, {1, 1, 1}).rgb.empty());
}

}  // namespace
}  // namespace rastercheck::reports::image_test
