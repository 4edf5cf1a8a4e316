#include "backends/gl/internal/picture_texture.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace rastercheck::backends::gl::picture_texture_test {
namespace {

/// A texture whose four channels are all `values`.
cases::Texture gray(int width, int height, const std::vector<int>& values) {
  cases::Texture texture{width, height, {}};
  for (const int value : values) {
    texture.texels.insert(texture.texels.end(), 4, static_cast<std::uint8_t>(value));
  }
  return texture;
}

TEST(PictureTexture, HalvesAnEvenSize) {
  // 0.25 · (0 + 1 + 2 + 7) = 2.5, and 0.25 · (10 + 10 + 10 + 11) = 10.25.
  EXPECT_EQ(next_level(gray(4, 2, {0, 1, 10, 10, 2, 7, 10, 11})), gray(2, 1, {3, 10}));
  EXPECT_EQ(next_level(gray(1, 2, {4, 8})), gray(1, 1, {6}));
  EXPECT_EQ(next_level(gray(2, 1, {255, 255})), gray(1, 1, {255}));
}

TEST(PictureTexture, WeightsTexelsOfAnOddSizeByOverlap) {
  EXPECT_EQ(next_level(gray(3, 1, {0, 30, 90})), gray(1, 1, {40}));
  // Each of two texels covers 2.5: (10 + 20 + 0.5 · 100)/2.5 and (0.5 · 100 + 5 + 0)/2.5.
  EXPECT_EQ(next_level(gray(5, 1, {10, 20, 100, 5, 0})), gray(2, 1, {32, 22}));
}

TEST(PictureTexture, KeepsChannelsApart) {
  const cases::Texture two{2, 1, {1, 2, 3, 4, 5, 6, 7, 8}};
  EXPECT_EQ(next_level(two), (cases::Texture{1, 1, {3, 4, 5, 6}}));
}

}  // namespace
}  // namespace rastercheck::backends::gl::picture_texture_test
