#pragma once

#include <string>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::reports {

/// The first screen of report.html: the verdict, the figures of the whole run, every law on every
/// backend, what was not checked, how to repeat the run, and where it ran.
std::string front_of(const records::Run& run, const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
