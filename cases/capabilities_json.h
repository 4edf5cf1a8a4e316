#pragma once

// Capabilities as JSON:
//
//   {"rules": ["opengl"], "sample_counts": [1, 4], "lacks": ["depth_range"], "max_size": 4096,
//    "max_viewport": 8192, "max_attributes": 8, "max_clip_distances": 0, "numbers": {"least": "…",
//    "greatest": "…"}}
//
// A key is absent where nothing is beyond a backend.

#include <nlohmann/json_fwd.hpp>

#include "cases/capabilities.h"
#include "cases/json_members.h"

namespace rastercheck::cases {

void write_value(nlohmann::json& to, const Capabilities& capabilities);
/// Refuses unknown keys, and what leaves no case to draw.
void read_value(const JsonNode& node, Capabilities& capabilities);

}  // namespace rastercheck::cases
