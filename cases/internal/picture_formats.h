#pragma once

// The readers of picture formats, one per source file. Each takes a whole file and returns the
// picture, or the reason why it cannot be read.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "cases/picture_file.h"
#include "cases/picture_reader.h"

namespace rastercheck::cases {

/// A picture, or a reason of one line.
using PictureOrReason = tl::expected<PictureFile, std::string>;

bool is_exr(std::string_view bytes);
PictureOrReason read_exr(std::string_view bytes);

bool is_png(std::string_view bytes);
PictureOrReason read_png(std::string_view bytes);

bool is_npy(std::string_view bytes);
PictureOrReason read_npy(std::string_view bytes, ArrayOrder order);

bool is_pfm(std::string_view bytes);
PictureOrReason read_pfm(std::string_view bytes);

/// The reason to refuse a picture of this size, before any memory is reserved for it.
std::optional<std::string> size_fault(std::uint64_t width, std::uint64_t height,
                                      std::uint64_t channels);

}  // namespace rastercheck::cases
