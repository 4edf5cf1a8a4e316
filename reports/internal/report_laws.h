#pragma once

#include <string>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::reports {

/// report.html, law by law: what was found on each backend. Violated laws are open.
std::string laws_of(const records::Run& run, const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
