#pragma once

#include <string>
#include <vector>

#include "records/summary.h"

namespace rastercheck::reports {

/// The part of report.html that says which wrong drawings the run would have noticed. Empty if no
/// drawing was made wrong.
std::string power_of(const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
