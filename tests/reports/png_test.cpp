#include "reports/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/decoded_png.h"

namespace rastercheck::reports::png_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// An image in which every pixel has another colour.
Image gradient(int width, int height) {
  Image image = Image::filled(width, height, {0, 0, 0});
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      image.set(column, row,
                {static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row),
                 static_cast<std::uint8_t>(column ^ row)});
    }
  }
  return image;
}

// Kills: rows upside down; swapped channels; a missing row.
TEST(ToPng, IsReadBackByLibpng) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {200, 120}}) {
    const Image image = gradient(width, height);
    const Result<std::string> png = to_png(image);
    ASSERT_TRUE(png.has_value());
    EXPECT_THAT(*png, StartsWith("\x89PNG\r\n\x1a\n"));
    EXPECT_EQ(decoded_png(*png), image);
  }
}

TEST(ToPng, SameImageSameBytes) {
  const std::string png = to_png(gradient(60, 40)).value();
  EXPECT_EQ(to_png(gradient(60, 40)).value(), png);
  for (const char* chunk : {"tIME", "tEXt", "zTXt", "iTXt"})
    EXPECT_THAT(png, Not(HasSubstr(chunk)));
}

TEST(ToPng, RefusesWhatIsNoImage) {
  EXPECT_EQ(to_png({}).error().reason, "no PNG: no pixels");
  EXPECT_EQ(to_png({0, 4, {}}).error().reason, "no PNG: no pixels");
  EXPECT_EQ(to_png({4, -1, {}}).error().reason, "no PNG: no pixels");
  EXPECT_EQ(to_png({2, 2, {1, 2, 3}}).error().reason, "no PNG: 3 bytes of colour for 2 × 2 pixels");
}

}  // namespace
}  // namespace rastercheck::reports::png_test
