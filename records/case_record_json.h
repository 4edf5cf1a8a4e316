#pragma once

// Case records as JSON:
//
//   {"law": "…", "backend": "cpu", "origin": "random", "index": 12, "name": "…",
//    "stratum": "…", "outcome": "held", "source": "0123456789abcdef", "found": "…",
//    "mismatches": 3,
//    "worst": {"smooth": {"sliver": {"error": [-0.5, -0.5], "exact": "84/5", "actual": "0x…p+4",
//                                    "triangle": 0, "x": 3, "y": 5, "sample": 0,
//                                    "attribute": 0}}}}
//
// "name", "mismatches" and "worst" are absent where there are none. Digests have 16 hexadecimal
// digits. A worst error is as in records (record_json.h), but for its "case".

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cases/json_node.h"
#include "records/case_record.h"

namespace rastercheck::records {

nlohmann::json case_record_to_json(const CaseKey& key, const CaseRecord& record);
nlohmann::json case_records_to_json(const CaseRecordSet& records);

/// An array of such objects, in the order of their keys. Refuses two of one key.
CaseRecordSet case_records_from_json(const cases::JsonNode& array);

/// Its "worst" alone, of a case of that index and name.
nlohmann::json worst_of_case_to_json(const WorstOfCase& worst);
WorstOfCase worst_of_case_from_json(const cases::JsonNode& node, std::uint64_t index,
                                    const std::string& name);

/// A digest as text, and back.
std::string digest_text(std::uint64_t digest);
std::uint64_t digest_from_json(const cases::JsonNode& node);

}  // namespace rastercheck::records
