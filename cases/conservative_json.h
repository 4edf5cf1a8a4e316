#pragma once

// Conservative coverage in contract files (cases/contract_json.h).

#include <optional>
#include <string>

#include "cases/coverage.h"
#include "cases/json_node.h"

namespace rastercheck::cases {

/// Reads an object, or "none". Refuses values that contradict each other.
std::optional<Conservative> read_conservative(const JsonNode& node);

/// The text that read_conservative() reads.
std::string conservative_text(const std::optional<Conservative>& conservative);

}  // namespace rastercheck::cases
