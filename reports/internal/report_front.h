#pragma once

#include <string>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

// The parts of report.html about the whole run.

namespace rastercheck::reports {

/// The headline: what was judged, whether it is right, how many causes, known defects.
std::string front_of(const records::Run& run, const std::vector<records::LawSummary>& rows);

/// The scene's result, with a preview of the drawing; empty if the run has no scene.
std::string scene_section(const records::Run& run);

/// How much was judged, and the largest errors, in large type.
std::string judged_section(const records::Run& run, const std::vector<records::LawSummary>& rows);

/// Lists the laws that held on few cases, and what was not checked, and why.
std::string gaps_section(const records::Run& run, const std::vector<records::LawSummary>& rows);

/// How to repeat the run, and what it ran on.
std::string again_section(const records::Run& run);

}  // namespace rastercheck::reports
