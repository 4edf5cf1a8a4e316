#pragma once

// The cases of a comparison that got worse, inspected, for compare.html.

#include <cstddef>
#include <string>

#include "records/comparison.h"
#include "reports/compare_format.h"

namespace rastercheck::reports {

/// The id of a grown case's section; `number` is the comparison's number on the page.
std::string growth_id(std::size_t number, std::size_t growth);

/// A section for each grown case: values, places, the stages that made the error, old and new
/// pixels, and commands that check the case again. Then the crops whose pixels differ from those of
/// the baseline.
std::string growth_sections(const Gate& gate, std::size_t number);

}  // namespace rastercheck::reports
