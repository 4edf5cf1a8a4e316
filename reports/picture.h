#pragma once

#include "cases/case.h"
#include "cases/framebuffer.h"
#include "records/error_map.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// What a backend drew, to be looked at: of each pixel the nearest fragment of the first sample
/// that has one, coloured by attributes 0 and 1 over the range that they have in the picture (by
/// depth where there are no attributes) and lit from the upper left by the relief of the depth.
/// Pixels without fragments are light grey; those whose depth or attributes are no finite numbers
/// are magenta. As large as the case's framebuffer; fragments outside it are ignored.
///
/// The same to the bit wherever it is drawn.
Image draw_picture(const cases::Case& c, const cases::Framebuffer& drawn);

/// The error of each pixel as a colour, from dark blue (2^-6 scale ULP and less) over green to
/// yellow (2^10 and more) on a logarithmic scale; violated pixels and their four neighbours are
/// red; where nothing is drawn it is light grey. Below stands a legend, and the image is as much
/// wider than the map as the legend needs. `y_up`: whether row 0 of the map is at the bottom.
///
/// The map has `width` · `height` states and errors. The same to the bit wherever it is drawn.
Image draw_error_map(const records::ErrorMap& map, bool y_up);

}  // namespace rastercheck::reports
