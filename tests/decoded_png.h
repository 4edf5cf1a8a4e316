#pragma once

#include <png.h>

#include <string>

#include "reports/image.h"

namespace rastercheck {

/// The image that libpng reads from the bytes of a file; an empty image if libpng refuses them.
inline reports::Image decoded_png(const std::string& bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) return {};
  header.format = PNG_FORMAT_RGB;
  reports::Image image;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.rgb.resize(PNG_IMAGE_SIZE(header));
  if (png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr) == 0) return {};
  return image;
}

}  // namespace rastercheck
