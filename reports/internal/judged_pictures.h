#pragma once

#include <string>

#include "cases/error.h"
#include "reports/internal/picture_colors.h"
#include "reports/judged_page.h"

namespace rastercheck::reports {

/// Returns the section with the picture, its verdicts and its differences, each a PNG in the page.
/// On large pictures, frames mark the parts and link to them. A PNG that would be too large is
/// shrunk; a block of verdicts then shows the worst one in it, so that no wrong pixel is lost.
/// Fails if a PNG cannot be encoded.
Result<std::string> pictures_section(const JudgedPage& page, const PictureColors& colors);

}  // namespace rastercheck::reports
