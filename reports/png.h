#pragma once

#include <string>

#include "cases/error.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// The bytes of a PNG file: 8-bit RGB, sRGB, no time, no text; the same image gives the same bytes
/// with the same libpng and zlib. Refuses an image without pixels, one whose `rgb` has another size
/// than its width and height say, and one that libpng cannot hold.
Result<std::string> to_png(const Image& image);

}  // namespace rastercheck::reports
