#pragma once

#include "cases/case.h"
#include "records/error_map.h"
#include "reports/error_scale.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// The error of each pixel as a colour of the scale, in whose unit the map's errors are; violated
/// pixels and their four neighbours have a colour of their own; where nothing is drawn it is light
/// grey. `rules` are those of the case: they say where window y points.
///
/// The map has `width` · `height` states and errors. The same to the bit wherever it is drawn.
Image draw_errors(const records::ErrorMap& map, cases::Rules rules, const ErrorScale& scale);

/// The same in scale ULP, with a legend below; the image is as much wider than the map as the
/// legend needs.
Image draw_error_map(const records::ErrorMap& map, cases::Rules rules);

}  // namespace rastercheck::reports
