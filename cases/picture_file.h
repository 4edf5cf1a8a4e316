#pragma once

// A picture as an image file holds it.

#include <cstddef>
#include <string>
#include <vector>

#include "cases/picture_layout.h"

namespace rastercheck::cases {

struct PictureFile {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  /// In the file's order: R, G, B, A, or Y for grey; EXR files name their own. Five and more
  /// channels without names are numbered from 0.
  std::vector<std::string> channels;
  /// How each channel's numbers are stored: never srgb8, which no file tells apart from unorm8.
  std::vector<Storage> stored;
  /// [row][x][channel], the uppermost row first. Floats are stored as they are; a unorm number
  /// k/255 or k/65535 is stored as the integer k.
  std::vector<float> values;

  std::size_t value_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * channels.size();
  }
  const float* pixel(int x, int row) const {
    const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x);
    return values.data() + at * channels.size();
  }
};

/// The names of `count` channels that a file does not name.
std::vector<std::string> default_channel_names(std::size_t count);

}  // namespace rastercheck::cases
