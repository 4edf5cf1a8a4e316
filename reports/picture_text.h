#pragma once

// How a judged picture looks as text, and as pictures.

#include <string>

#include "cases/picture_view.h"
#include "records/judged_picture.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// For a terminal: the verdict, a table of what is wrong, the pixels that are farthest off, and how
/// much the case leaves open. `is_brief`: the table's rows only.
std::string picture_text(const records::JudgedPicture& judged, bool is_brief);

/// As JSON, "rastercheck-judged-picture", version 1 (docs/commands.md).
std::string picture_json(const records::JudgedPicture& judged, const cases::PictureView& view);

/// The verdict of each pixel as a colour: right ones dark grey, wrong ones bright.
Image verdict_image(const records::JudgedPicture& judged);
/// Explains each colour of verdict_image().
std::string verdict_legend();

}  // namespace rastercheck::reports
