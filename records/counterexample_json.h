#pragma once

// A counterexample as JSON:
//
//   {"case": {the case file, docs/case-format.md}, "violation_count": 12,
//    "violations": [{"class": "beyond bound", "kind": "smooth", "triangle": 0, "x": 3, "y": 5,
//                    "sample": 0, "attribute": 0, "exact": "84/5", "actual": "16.8
//                    (0x1.0cccccp+4)", "error": [0.7, 0.7], "bound": [0.5, 0.5], "note": ""}],
//    "origin": "random", "shrinking": {"tries": 214, "is_least": true},
//    "explanation": {"parts": ["values"], "wrong": [], "also_violates": [], "needs": ["samples"],
//                    "inherent": [], "indifferent": ["tie"]}, "close_up": ["…"]}
//
// "attribute", "error", "bound" and "distance" are absent if the violation has none; "shrinking",
// "explanation" and "close_up" if the counterexample has none. "explanation" may also have "hints",
// a list of clauses, and "fails_again": false. Texts are UTF-8.

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/counterexample.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const Violation& violation);
void read_value(const cases::JsonNode& node, Violation& violation);

void write_value(nlohmann::json& to, const Counterexample& counterexample);
/// Refuses unknown and missing keys, and anything a case file may not contain. A missing "origin",
/// as in older files, means random.
void read_value(const cases::JsonNode& node, Counterexample& counterexample);

}  // namespace rastercheck::records
