#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rastercheck::reports {

/// Red, green, blue; sRGB, 0…255.
using Color = std::array<std::uint8_t, 3>;

/// The colour of pixels where nothing is drawn: light grey.
inline constexpr Color kUndrawn{242, 242, 238};

struct Image {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  /// [(row · width + column) · 3 + channel], row 0 on top.
  std::vector<std::uint8_t> rgb;
  bool operator==(const Image&) const = default;

  /// An image filled with one colour.
  static Image filled(int width, int height, Color color);

  Color at(int column, int row) const;
  /// Does nothing outside the image.
  void set(int column, int row, Color color);
};

}  // namespace rastercheck::reports
