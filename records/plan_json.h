#pragma once

// A plan as JSON:
//
//   {"seed": 1, "cases_per_property": 1000, "backends": ["cpu"], "properties": ["…"],
//    "property_patterns": ["*edge*"], "scene": "bunny.obj", "scene_size": 512,
//    "contract": {"file": "…", "terms": {a contract file}}, "corpus": "…", "known": ["…"],
//    "ignores_known": true, "shrink_tries": 1000, "shrink_seconds": 5, "power": 5,
//    "require_cases": 20, "keeps_cases": true, "timeout": 10, "shard": {"index": 2, "count": 7}}
//
// "properties" are the ids of the properties that are checked, "property_patterns" the patterns
// that chose them (--property).
//
// All keys except "seed" and "cases_per_property" are absent for default values (plan.h).

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/plan.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const Plan& plan);
/// Refuses unknown and missing keys, and invalid values.
void read_value(const cases::JsonNode& node, Plan& plan);

}  // namespace rastercheck::records
