#pragma once

#include "cases/case.h"
#include "cases/fragments.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// Makes an image of a backend's drawing. Each pixel shows the nearest fragment of its first
/// covered sample. It is coloured by attributes 0 and 1 over their range in the picture (by depth
/// if there are no attributes) and lit from the upper left by the relief of the depth. Pixels
/// without fragments are light grey. Pixels whose depth or attributes are not finite are magenta.
/// The image is as large as the case's framebuffer; fragments outside are ignored.
///
/// The image is the same to the bit on every machine.
Image draw_picture(const cases::Case& c, const cases::Fragments& drawn);

}  // namespace rastercheck::reports
