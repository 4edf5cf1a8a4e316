#pragma once

#include <string>

#include "cases/error.h"
#include "reports/internal/picture_colors.h"
#include "reports/judged_page.h"

namespace rastercheck::reports {

/// The section with the picture, its verdicts and its differences, each a PNG within the page. On
/// large ones, frames mark the parts and lead to them. A picture whose file would be too large for
/// a page is shown smaller; then a block of pixels has the worst verdict in it, so that no wrong
/// pixel is lost. Fails if one cannot be encoded.
Result<std::string> pictures_section(const JudgedPage& page, const PictureColors& colors);

}  // namespace rastercheck::reports
