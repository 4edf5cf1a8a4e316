#pragma once

#include <string>

#include "records/run.h"

namespace rastercheck::reports {

/// A picture of a run with its sentence, as HTML; whatever it needs is in it. One that is narrower
/// than 320 pixels is enlarged.
std::string picture_figure(const records::Picture& picture);

}  // namespace rastercheck::reports
