#pragma once

#include <string>

#include "cases/error.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// Encodes an image as a PNG file: 8-bit RGB, sRGB, no time, no text. The same image gives the same
/// bytes with the same libpng and zlib. Fails if the image has no pixels, if the size of `rgb` does
/// not match its width and height, or if libpng cannot hold the image.
Result<std::string> to_png(const Image& image);

}  // namespace rastercheck::reports
