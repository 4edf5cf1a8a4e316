#pragma once

// One inspected sample for people, on a terminal.

#include <cstddef>
#include <optional>
#include <string>

#include "records/inspection.h"

namespace rastercheck::reports {

/// The sample that was looked for over several lines, each of at most 80 characters but for names:
/// triangle, verdict, q-matrix and edges, and of each value what is exact, what was drawn, its
/// errors, and the error split by stage. `value` is an index into InspectedSample::values: only
/// that one is shown then.
std::string inspection_text(const records::Inspection& inspection,
                            std::optional<std::size_t> value = std::nullopt);

/// What the numbers mean.
std::string inspection_legend();

}  // namespace rastercheck::reports
