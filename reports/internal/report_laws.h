#pragma once

#include <string>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::reports {

/// The part of report.html with a row for each property and backend that was checked, the most
/// urgent first. Each row opens with histograms, strata, stages, classes and labels.
std::string properties_section(const records::Run& run,
                               const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
