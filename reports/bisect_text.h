#pragma once

// Prints the result of a bisection, for people and for programs.

#include <cstdint>
#include <string>

#include "records/bisection.h"

namespace rastercheck::reports {

/// "12 entries are worse".
std::string worse_text(std::uint64_t entries);

/// Names the first worse commit and the case whose error grew most, and says how the commit was
/// found.
std::string bisect_text(const records::BisectOutcome& outcome);
/// The outcome as JSON, on one line.
std::string bisect_json(const records::BisectOutcome& outcome);

}  // namespace rastercheck::reports
