#pragma once

// The first screen of compare.html: whether anything got worse, what did, and where most.

#include <cstddef>
#include <string>

#include "reports/compare_format.h"

namespace rastercheck::reports {

/// "Regression on 1 of 3 backends."; for a single comparison, that comparison's own sentence.
std::string compare_headline(const Gate& gate);

/// Describes the outcome of one comparison: figures, the largest growth, what was compared, and
/// what to do.
std::string compare_front(const Gate& gate, std::size_t number);

/// Lists the lines of the policy that have expired or are unused; empty if there are none.
std::string policy_section(const records::PolicyReview& review);

}  // namespace rastercheck::reports
