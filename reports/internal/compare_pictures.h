#pragma once

// A part of a drawing as it was, as it is, and what changed, as pictures for compare.html.

#include <optional>
#include <string>

#include "records/closer_look.h"
#include "records/enclosure.h"

namespace rastercheck::reports {

/// Pictures of old errors, new errors and changes, with what they show as text, and the pixels that
/// changed most as a table. Where the baseline kept nothing of it, that is said, and the picture of
/// changes is of what is certain: of each pixel the least change, |new error| − r with r the
/// `worst_before` of the case, its largest error of the same kind and stratum in the baseline;
/// nothing: not known, and so no such picture.
std::string compare_pictures(const records::CloserLook& look,
                             const std::optional<records::Enclosure>& worst_before);

/// What the colours of these pictures mean.
std::string picture_legend();

/// Style sheet of the classes that they use.
std::string picture_style();

}  // namespace rastercheck::reports
