#pragma once

#include <string>

#include "records/stage_split.h"

namespace rastercheck::reports {

/// An error split by stages, as an HTML table with a bar for each part: it begins where the one
/// before ended, so that the last ends at the total. Numbers stand beside the bars, in scale ULP.
/// Colours come from the page (--above, --below, --muted).
std::string split_table(const records::ErrorSplit& split);

}  // namespace rastercheck::reports
