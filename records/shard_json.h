#pragma once

// A shard as JSON:
//
//   {"is_whole": true, "corpus_digest": "0123456789abcdef",
//    "promises": [{"backend": "cpu", "has_limits": false, "draws_what_is_asked_for": true,
//                  "unpromised": ["…"]}],
//    "known_digest": "…", "scene_digest": "…", "saved": [{a case file}, …]}
//
// The last three are absent if empty.

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/shard.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const Shard& shard);
void read_value(const cases::JsonNode& node, Shard& shard);

}  // namespace rastercheck::records
