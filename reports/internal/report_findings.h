#pragma once

#include <string>

#include "records/run.h"

namespace rastercheck::reports {

/// Sections of report.html; empty if they have nothing to show.
struct Findings {
  /// The causes, largest first, each with its counterexamples. The first counterexample is open.
  std::string counterexamples;
  std::string worst;  ///< the largest errors, permitted or not
};
Findings findings_of(const records::Run& run);

}  // namespace rastercheck::reports
