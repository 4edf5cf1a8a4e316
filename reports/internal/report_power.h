#pragma once

#include <string>
#include <vector>

#include "records/summary.h"

namespace rastercheck::reports {

/// report.html, what the run would have noticed of drawings that are wrong; empty where none was
/// made wrong.
std::string power_of(const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
