#pragma once

// Capabilities as JSON:
//
//   {"rules": ["opengl"], "sample_counts": [1, 4], "lacks": ["depth_range"], "max_size": 4096,
//    "max_viewport": 8192, "max_attributes": 8, "max_clip_distances": 0, "numbers": {"least": "…",
//    "greatest": "…"}}
//
// A key is absent if it sets no limit. Readers accept lists in any order.

#include <nlohmann/json_fwd.hpp>

#include "cases/capabilities.h"
#include "cases/json_members.h"

namespace rastercheck::cases {

void write_value(nlohmann::json& to, const Capabilities& capabilities);
/// Refuses unknown keys, and capabilities that no case fits.
void read_value(const JsonNode& node, Capabilities& capabilities);

}  // namespace rastercheck::cases
