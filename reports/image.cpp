#include "reports/image.h"

#include <cassert>

namespace rastercheck::reports {
namespace {

std::size_t offset_of(const Image& image, int column, int row) {
  return (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
          static_cast<std::size_t>(column)) *
         3;
}

bool has(const Image& image, int column, int row) {
  return column >= 0 && row >= 0 && column < image.width && row < image.height;
}

}  // namespace

Image Image::filled(int width, int height, Color color) {
  Image image{width, height, {}};
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  image.rgb.reserve(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i) {
    image.rgb.insert(image.rgb.end(), color.begin(), color.end());
  }
  return image;
}

Color Image::at(int column, int row) const {
  assert(has(*this, column, row));
  const std::size_t offset = offset_of(*this, column, row);
  return {rgb[offset], rgb[offset + 1], rgb[offset + 2]};
}

void Image::set(int column, int row, Color color) {
  if (!has(*this, column, row)) return;
  const std::size_t offset = offset_of(*this, column, row);
  for (std::size_t channel = 0; channel < 3; ++channel) rgb[offset + channel] = color[channel];
}

}  // namespace rastercheck::reports
