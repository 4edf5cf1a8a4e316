#pragma once

// Lists of known defects as JSON:
//
//   {"format": "rastercheck-known", "version": 1,
//    "driver": {"name": "llvmpipe", "version": "Mesa 22.3.6"},
//    "entries": [{"id": "llvmpipe-1", "reason": "…", "rule": "OpenGL 4.6, 14.6.1",
//                 "finding": "llvmpipe-1", "laws": ["values-stay-within-the-bound", "*edge*"],
//                 "verdicts": ["beyond bound"],
//                 "when": {"nonpositive_w": true, "samples": [2, 4], "error_at_most": 1000},
//                 "case": "known/llvmpipe-1.json"}]}
//
// and of run.json: what was known of a run's backends, and which entries no longer show.
// cases/schema/known.schema.json says the same; known.h says what conditions mean.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cases/json_node.h"
#include "records/known.h"

namespace rastercheck::records {

/// Refuses unknown and missing keys, two entries of one id, entries without a law, a verdict or a
/// condition, and case files outside the list's folder.
KnownList known_from_json(const cases::JsonNode& root);
Result<KnownList> parse_known(std::string_view text, const std::string& file);

nlohmann::json known_to_json(const KnownList& list);

/// Of run.json: a list is written whole.
nlohmann::json known_of_backend_to_json(const KnownOfBackend& known);
KnownOfBackend known_of_backend_from_json(const cases::JsonNode& node);
nlohmann::json unexpected_pass_to_json(const UnexpectedPass& pass);
UnexpectedPass unexpected_pass_from_json(const cases::JsonNode& node);

}  // namespace rastercheck::records
