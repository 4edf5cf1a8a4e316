#pragma once

// Outcomes of cases as JSON:
//
//   {"property": "…", "backend": "gl:llvmpipe", "origin": "random", "right": [[0, 6], [8, 59]],
//    "wrong": [[7, 7]], "unlike": {"gl:softpipe": [[3, 4]]}}
//
// A pair is the first and the last number of neighbouring cases; pairs ascend, and at least one
// number lies between two of them. "right", "wrong", "known" and "unlike" are absent if empty.
//
// A difference:
//
//   {"case": {the case file, with "found"}, "right": "gl:llvmpipe", "origin": "random"}

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/case_outcomes.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const CaseOutcomeSet::value_type& one);
/// An array of such objects in key order. Reading refuses duplicate keys, ranges out of order and
/// cases with two outcomes.
void write_value(nlohmann::json& to, const CaseOutcomeSet& outcomes);
void read_value(const cases::JsonNode& node, CaseOutcomeSet& outcomes);

void write_value(nlohmann::json& to, const Difference& difference);
/// Refuses a case without 'found'.
void read_value(const cases::JsonNode& node, Difference& difference);

}  // namespace rastercheck::records
