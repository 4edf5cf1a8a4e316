#pragma once

// Lists of known defects as JSON:
//
//   {"format": "rastercheck-known", "version": 1,
//    "driver": {"name": "llvmpipe", "version": "Mesa 22.3.6"},
//    "entries": [{"id": "llvmpipe-1", "reason": "…", "rule": "OpenGL 4.6, 14.6.1",
//                 "finding": "llvmpipe-1",
//                 "properties": ["values-stay-within-the-bound", "*edge*"],
//                 "verdicts": ["beyond bound"],
//                 "when": {"nonpositive_w": true, "samples": [2, 4], "error_at_most": 1000},
//                 "case": "known/llvmpipe-1.json"}]}
//
// A list without a driver lacks "driver"; its entries may lack "rule", "finding" and "properties",
// and may have "backends": ["plugin:libmine.so"] and "until": "2027-01-31".
//
// Also reads and writes the parts of run.json: known lists of the run's backends, and entries whose
// defects no longer show. cases/schema/known.schema.json defines the same format; known.h explains
// the conditions.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cases/json_members.h"
#include "records/known.h"

namespace rastercheck::records {

/// Refuses unknown and missing keys, duplicate ids, entries without a verdict or a condition,
/// invalid dates, and case files outside the list's folder; in a driver's list also entries without
/// a rule, a finding or a law.
void read_value(const cases::JsonNode& node, KnownList& list);
void write_value(nlohmann::json& to, const KnownList& list);
Result<KnownList> parse_known(std::string_view text, const std::string& file);

/// For run.json: writes the whole list.
void write_value(nlohmann::json& to, const KnownOfBackend& known);
void read_value(const cases::JsonNode& node, KnownOfBackend& known);
void write_value(nlohmann::json& to, const UnexpectedPass& pass);
void read_value(const cases::JsonNode& node, UnexpectedPass& pass);

}  // namespace rastercheck::records
