#pragma once

// Textures for the tests.

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <vector>

#include "rasterizer/texture.h"
#include "tests/rasterizer/exact.h"

namespace rastercheck::rasterizer {

inline std::vector<std::uint8_t> random_bytes(Random& random, int width, int height) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width * height) * 4);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.between(0, 255));
  return bytes;
}

inline Texture made(int width, int height, std::span<const std::uint8_t> bytes) {
  Texture texture;
  EXPECT_FALSE(Texture::make(width, height, bytes, texture));
  return texture;
}

inline Texture random_texture(Random& random, int width, int height) {
  return made(width, height, random_bytes(random, width, height));
}

inline int byte_at(const Texture& texture, std::size_t level, int x, int y, std::size_t channel) {
  const auto at = static_cast<std::size_t>(y * texture.width(level) + x);
  return static_cast<int>(texture.texels(level)[at] >> 8 * channel & 255U);
}

}  // namespace rastercheck::rasterizer
