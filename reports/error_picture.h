#pragma once

#include "cases/case.h"
#include "records/error_map.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// The error of each pixel as a colour, from dark blue (2^-6 scale ULP and less) over green to
/// yellow (2^10 and more) on a logarithmic scale; violated pixels and their four neighbours are
/// red; where nothing is drawn it is light grey. Below stands a legend, and the image is as much
/// wider than the map as the legend needs. `rules` are those of the case: they say where window y
/// points.
///
/// The map has `width` · `height` states and errors. The same to the bit wherever it is drawn.
Image draw_error_map(const records::ErrorMap& map, cases::Rules rules);

}  // namespace rastercheck::reports
