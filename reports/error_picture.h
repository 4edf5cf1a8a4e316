#pragma once

#include "cases/case.h"
#include "records/error_map.h"
#include "reports/error_scale.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// Colours each pixel by its error, on a scale whose unit is that of the map's errors. Violated
/// pixels and their four neighbours have a colour of their own. Pixels where nothing is drawn are
/// light grey. `rules` must be those of the case, as they decide where window y points.
///
/// The map must have `width` · `height` states and errors. The image is the same to the bit on
/// every machine.
Image draw_errors(const records::ErrorMap& map, cases::Rules rules, const ErrorScale& scale);

/// Draws errors in scale ULP, with a legend below. If the legend is wider than the map, the image
/// is as wide as the legend.
Image draw_error_map(const records::ErrorMap& map, cases::Rules rules);

}  // namespace rastercheck::reports
