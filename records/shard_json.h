#pragma once

// A shard as JSON:
//
//   {"index": 2, "count": 7, "is_whole": true, "corpus_digest": "0123456789abcdef",
//    "promises": [{"backend": "cpu", "has_limits": false, "draws_what_is_asked_for": true,
//                  "unpromised": ["…"]}],
//    "known_digest": "…", "scene_digest": "…", "contract": {a contract file},
//    "saved": [{a case file}, …]}
//
// The last four are absent where there is nothing of the kind.

#include <nlohmann/json_fwd.hpp>

#include "cases/json_node.h"
#include "records/shard.h"

namespace rastercheck::records {

nlohmann::json shard_to_json(const Shard& shard);
Shard shard_from_json(const cases::JsonNode& node);

/// The number alone, {"index": 2, "count": 7}; refuses one that there is not.
nlohmann::json shard_number_to_json(const ShardNumber& number);
ShardNumber shard_number_from_json(const cases::JsonNode& node);

}  // namespace rastercheck::records
