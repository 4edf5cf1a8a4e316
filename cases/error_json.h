#pragma once

// An error as JSON, as this program's processes exchange it:
//
//   {"error": {"file": "…", "place": "…", "reason": "…"}}

#include <nlohmann/json_fwd.hpp>

#include "cases/error.h"
#include "cases/json_node.h"

namespace rastercheck::cases {

nlohmann::json error_to_json(const Error& error);

/// Refuses unknown and missing keys, and an error without a reason.
Error error_from_json(const JsonNode& node);

}  // namespace rastercheck::cases
