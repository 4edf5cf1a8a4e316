#pragma once

// Reads pictures: OpenEXR, PNG, NPY and PFM, told apart by their first bytes. A reader of images is
// a classic target of broken files, so programs should read pictures in a separate process
// (picture_process.h).

#include <string>
#include <string_view>

#include "cases/error.h"
#include "cases/picture_file.h"

namespace rastercheck::cases {

/// The order of a NumPy array's axes: height, width, channel or channel, height, width. An array of
/// two axes is height, width.
enum class ArrayOrder { hwc, chw };

/// Reads a picture file, or standard input for "-":
///
///   OpenEXR  half, float and uint channels, scan lines or tiles; the first part of several
///   PNG      grey or colour, 8 or 16 bits, with or without alpha; the stored numbers, unchanged
///   NPY      little-endian float16, float32, uint8 and uint16 arrays in C order
///   PFM      grey or colour
///
/// Refuses pictures wider or higher than kMaxSize pixels, or with more than 2^28 numbers, before
/// it reserves memory for them; and palettes, deep and subsampled pictures.
Result<PictureFile> read_picture(const std::string& file, ArrayOrder order);

/// Like read_picture(), for the bytes of a file; `file` is the name used in errors.
Result<PictureFile> parse_picture(std::string_view bytes, const std::string& file,
                                  ArrayOrder order);

}  // namespace rastercheck::cases
