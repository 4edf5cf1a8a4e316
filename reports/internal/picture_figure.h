#pragma once

#include <string>

#include "records/run.h"

namespace rastercheck::reports {

/// A picture of a run with its caption, as self-contained HTML. Pictures narrower than 320 pixels
/// are enlarged.
std::string picture_figure(const records::Picture& picture);

}  // namespace rastercheck::reports
