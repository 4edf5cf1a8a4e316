#pragma once

#include <string>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::reports {

/// The part of report.html with the findings of each law on each backend. Violated laws are
/// expanded.
std::string laws_of(const records::Run& run, const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
