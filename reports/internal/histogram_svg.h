#pragma once

#include <string>
#include <string_view>

#include "records/histogram.h"

namespace rastercheck::reports {

/// A histogram as an SVG element: a bar for each octave of magnitude from the least to the greatest
/// that was seen, one for exactly 0, one for what lies beyond the last border. Both axes are
/// logarithmic. Colours come from the page (--ink, --muted, --line, --accent). Empty where nothing
/// finite was counted. `title` is what readers hear who do not see it.
std::string histogram_svg(const records::Histogram& histogram, std::string_view title);

}  // namespace rastercheck::reports
