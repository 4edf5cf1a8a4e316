#pragma once

// Writes pictures that picture_reader.h reads back unchanged.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cases/error.h"
#include "cases/picture_file.h"

namespace rastercheck::cases {

enum class PictureFormat { exr, png, npy, pfm };

/// The format that a file's name ends in: .exr, .png, .npy or .pfm.
std::optional<PictureFormat> picture_format_of(std::string_view file);

/// Texts that a picture carries, by keyword.
using PictureTexts = std::vector<std::pair<std::string, std::string>>;

/// Writes a picture. OpenEXR holds float32 and float16 channels; PNG unorm8 or unorm16 in one to
/// four channels named R, G, B, A or Y; NPY and PFM, which have no texts, hold channels of one
/// kind. Fails for others. Formats without names leave out the channels' names.
Result<void> write_picture(const PictureFile& picture, const std::string& file,
                           const PictureTexts& texts = {});

}  // namespace rastercheck::cases
