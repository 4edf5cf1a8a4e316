// Uses libpng's simplified interface, which catches its own long jumps and returns errors as text,
// so that no jump ever crosses a C++ frame. Compression level and filters are the fixed defaults of
// zlib and libpng; the chunks are IHDR, sRGB, IDAT and IEND.
//
// Rejected: the full interface with setjmp, whose only benefit would be the choice of another
// compression level.

#include "reports/png.h"

#include <fmt/format.h>
#include <png.h>

namespace rastercheck::reports {
namespace {

Error png_refusal(std::string reason) { return {"", "", "no PNG: " + std::move(reason)}; }

}  // namespace

Result<std::string> to_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0) return tl::unexpected(png_refusal("no pixels"));
  const std::size_t wanted =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3;
  if (image.rgb.size() != wanted) {
    return tl::unexpected(png_refusal(fmt::format("{} bytes of colour for {} × {} pixels",
                                                  image.rgb.size(), image.width, image.height)));
  }

  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;

  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) ==
      0) {
    return tl::unexpected(png_refusal(static_cast<const char*>(header.message)));
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace rastercheck::reports
