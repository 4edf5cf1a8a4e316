#pragma once

#include <string>

#include "records/stage_split.h"

namespace rastercheck::reports {

/// An error split by stages, as an HTML table with a bar for each part. Each bar begins where the
/// previous one ended, so the last bar ends at the total. Numbers beside the bars are in scale ULP.
/// The page supplies the colours (--above, --below, --muted).
std::string split_table(const records::ErrorSplit& split);

}  // namespace rastercheck::reports
