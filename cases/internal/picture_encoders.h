#pragma once

// The writers of picture formats, beside their readers. Each returns a whole file, or the reason
// why the format cannot hold the picture.

#include <string>
#include <tl/expected.hpp>

#include "cases/picture_writer.h"

namespace rastercheck::cases {

using BytesOrReason = tl::expected<std::string, std::string>;

BytesOrReason write_exr(const PictureFile& picture, const PictureTexts& texts);
BytesOrReason write_png(const PictureFile& picture, const PictureTexts& texts);
BytesOrReason write_npy(const PictureFile& picture);
BytesOrReason write_pfm(const PictureFile& picture);

}  // namespace rastercheck::cases
