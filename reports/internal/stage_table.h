#pragma once

#include <string>

#include "records/summary.h"

namespace rastercheck::reports {

/// Which stages made a law's errors, as an HTML table: of each kind and stratum a bar of their
/// shares, and the mean size of each one's part. Colours come from the page (.stage-0 and on, by
/// the order of records::Stage). Empty where errors were not split.
std::string stage_table(const records::LawSummary& row);

}  // namespace rastercheck::reports
