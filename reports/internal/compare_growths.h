#pragma once

// The cases of a comparison that came out worse, looked at, for compare.html.

#include <cstddef>
#include <string>

#include "records/comparison.h"
#include "reports/compare_format.h"

namespace rastercheck::reports {

/// The id of a grown case's section; `number` is that of the comparison on the page.
std::string growth_id(std::size_t number, std::size_t growth);

/// Each grown case: values, where they are, what made the error, old and new pixels, and what
/// checks it again. Then parts whose pixels are others than those that the baseline kept.
std::string growth_sections(const Gate& gate, std::size_t number);

}  // namespace rastercheck::reports
