#pragma once

// Describes one inspected sample, for a terminal.

#include <cstddef>
#include <optional>
#include <string>

#include "records/inspection.h"

namespace rastercheck::reports {

/// Describes the inspected sample over several lines of at most 80 characters, except for names:
/// the triangle, the verdict, the q-matrix and edges, and for each value the exact value, the drawn
/// value, its errors and how the error splits into stages. `value` is an index into
/// InspectedSample::values; if given, only that value is shown.
std::string inspection_text(const records::Inspection& inspection,
                            std::optional<std::size_t> value = std::nullopt);

/// Explains the numbers of inspection_text().
std::string inspection_legend();

}  // namespace rastercheck::reports
