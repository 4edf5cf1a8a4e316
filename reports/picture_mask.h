#pragma once

// How a mask (records::PictureMask) looks: as text, as a picture for people, as bounds for
// programs.

#include <string>

#include "cases/picture_file.h"
#include "records/judged_picture.h"

namespace rastercheck::reports {

/// Says how many pixels the case leaves open, for readers.
std::string mask_text(const records::PictureMask& mask);
/// As JSON, "rastercheck-mask", version 1.
std::string mask_json(const records::PictureMask& mask);

/// Shows as a colour what each pixel may hold. mask_legend() explains the colours.
cases::PictureFile mask_picture(const records::PictureMask& mask);
std::string mask_legend();

/// Has two channels per channel NAME of the mask: lower.NAME and upper.NAME, the permitted range.
cases::PictureFile bounds_picture(const records::PictureMask& mask);

}  // namespace rastercheck::reports
