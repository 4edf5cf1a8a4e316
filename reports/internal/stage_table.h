#pragma once

#include <string>

#include "records/summary.h"

namespace rastercheck::reports {

/// The stages that made a law's errors, as an HTML table. For each kind and stratum, it has a bar
/// of the stages' shares and the mean size of each stage's part. The page supplies the colours
/// (.stage-0 and on, in the order of records::Stage). Empty if errors were not split.
std::string stage_table(const records::LawSummary& row);

}  // namespace rastercheck::reports
