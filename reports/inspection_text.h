#pragma once

// Describes one inspected sample, for a terminal.

#include <cstddef>
#include <optional>
#include <string>

#include "records/inspection.h"

namespace rastercheck::reports {

/// Describes the inspected sample over several lines of at most 80 characters, except for names:
/// the verdict; for each value the exact value, the drawn value and its errors; the pixels around;
/// how errors split into stages; the triangle; the q-matrix and edges. `value` is an index into
/// InspectedSample::values; if given, only that value is shown.
std::string inspection_text(const records::Inspection& inspection,
                            std::optional<std::size_t> value = std::nullopt);

/// Explains the numbers of inspection_text().
std::string inspection_legend();

}  // namespace rastercheck::reports
