#pragma once

// The first screen of compare.html: whether it got worse, of what, and where most.

#include <cstddef>
#include <string>

#include "reports/compare_format.h"

namespace rastercheck::reports {

/// "Regression on 1 of 3 backends."; of one comparison its own sentence.
std::string compare_headline(const Gate& gate);

/// One comparison's outcome: figures, the largest growth, what was compared, what to do about it.
std::string compare_front(const Gate& gate, std::size_t number);

/// What the policy allows no more, or need not allow; empty where there is nothing to say.
std::string policy_section(const records::PolicyReview& review);

}  // namespace rastercheck::reports
