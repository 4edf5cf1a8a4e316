#pragma once

#include <string>

#include "reports/internal/picture_colors.h"
#include "reports/judged_page.h"

namespace rastercheck::reports {

/// Returns one part of a judged picture as JSON for the page's viewer (reports/viewer/part.js). The
/// text is safe within a <script> element.
std::string part_data(const JudgedPage& page, const PictureColors& colors,
                      const records::PicturePart& part);

}  // namespace rastercheck::reports
