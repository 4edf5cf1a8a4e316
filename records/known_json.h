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
// A list of no driver lacks "driver", and its entries may lack "rule", "finding" and "laws", and
// have "backends": ["plugin:libmine.so"] and "until": "2027-01-31".
//
// Of run.json: what was known of a run's backends, and which entries no longer show.
// cases/schema/known.schema.json says the same; known.h says what conditions mean.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cases/json_members.h"
#include "records/known.h"

namespace rastercheck::records {

/// Refuses unknown and missing keys, two entries of one id, entries without a verdict or a
/// condition, days that there are not, case files outside the list's folder, and in a driver's list
/// entries without a rule, a finding or a law.
void read_value(const cases::JsonNode& node, KnownList& list);
void write_value(nlohmann::json& to, const KnownList& list);
Result<KnownList> parse_known(std::string_view text, const std::string& file);

/// Of run.json: a list is written whole.
void write_value(nlohmann::json& to, const KnownOfBackend& known);
void read_value(const cases::JsonNode& node, KnownOfBackend& known);
void write_value(nlohmann::json& to, const UnexpectedPass& pass);
void read_value(const cases::JsonNode& node, UnexpectedPass& pass);

}  // namespace rastercheck::records
