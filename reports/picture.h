#pragma once

#include "cases/case.h"
#include "cases/fragments.h"
#include "reports/image.h"

namespace rastercheck::reports {

/// What a backend drew, to be looked at: of each pixel the nearest fragment of the first sample
/// that has one, coloured by attributes 0 and 1 over the range that they have in the picture (by
/// depth where there are no attributes) and lit from the upper left by the relief of the depth.
/// Pixels without fragments are light grey; those whose depth or attributes are no finite numbers
/// are magenta. As large as the case's framebuffer; fragments outside it are ignored.
///
/// The same to the bit wherever it is drawn.
Image draw_picture(const cases::Case& c, const cases::Fragments& drawn);

}  // namespace rastercheck::reports
