#pragma once

// An inspection as JSON:
//
//   {"occasion": "counterexample", "property": "…", "backend": "cpu", "counterexample": 0,
//    "kind": "smooth", "stratum": "sliver", "case": {the case file, docs/case-format.md},
//    "pattern": [[0.5, 0.5]], "triangle": 0, "x": 3, "y": 5, "sample": 0, "attribute": 0,
//    "q_matrix": [["1/2", "0", "-3/4"], […], […]], "outlines": [[[0.5, 1.25], [8, 1], [3, 7]]],
//    "left": 0, "top": 0, "width": 8, "height": 8,
//    "samples": [{"x": 3, "y": 5, "sample": 0, "verdict": "required", "reason": "inside",
//                 "is_drawn": true, "distance": [0.125, 0.125], "edges": [[1, 1], [0, 0], [2, 2]],
//                 "values": [{"attribute": 0, "exact": "84/5", "nearest": 16.8,
//                             "actual": "0x1.0cccccp+4", "scale_error": [0.7, 0.7],
//                             "local_error": [0.7, 0.7], "excess": [0.2, 0.2],
//                             "kappa": [1, 1], "kappa_d": [3.5, 3.5]}]}],
//    "splits": [{"attribute": 0, "parts": [{"stage": "set-up", "error": [0.7, 0.7]}],
//                "total": [0.7, 0.7], "is_traced": true}],
//    "coverage_stage": "snap"}
//
// Keys are the members of records/inspection.h, except "case" for `source`. Optional members are
// absent if they are empty, and so are a sample's "values" and a value's "exact". Exact values are
// texts; "actual" is a hex float, "nan", "inf" or "-inf". Texts are UTF-8.

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/inspection.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const Inspection& inspection);
/// Refuses unknown and missing keys, anything a case file may not contain, and samples outside the
/// inspected part.
void read_value(const cases::JsonNode& node, Inspection& inspection);

}  // namespace rastercheck::records
