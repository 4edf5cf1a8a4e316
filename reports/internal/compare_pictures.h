#pragma once

// Pictures of a part of a drawing, before and now, and of the changes, for compare.html.

#include <optional>
#include <string>

#include "records/closer_look.h"
#include "records/enclosure.h"

namespace rastercheck::reports {

/// Pictures of old errors, new errors and changes, described in text, and a table of the pixels
/// that changed most. If the baseline kept no pixels, the result says so, and shows only the
/// certain part of the changes. The certain part is, for each pixel, the least possible change,
/// |new error| − r, where r is `worst_before`, the largest error of the case in the baseline, of
/// the same kind and stratum. If `worst_before` is empty, r is unknown and this picture is left
/// out.
std::string compare_pictures(const records::CloserLook& look,
                             const std::optional<records::Enclosure>& worst_before);

/// A legend for the colours of these pictures.
std::string picture_legend();

/// The style sheet for the classes that these pictures use.
std::string picture_style();

}  // namespace rastercheck::reports
