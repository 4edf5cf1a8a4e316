#pragma once

// Case records as JSON:
//
//   {"property": "…", "backend": "cpu", "origin": "random", "index": 12, "name": "…",
//    "stratum": "…", "outcome": "held", "source": "0123456789abcdef", "found": "…",
//    "mismatches": 3,
//    "worst": {"smooth": {"sliver": {"error": [-0.5, -0.5], "exact": "84/5", "actual": "0x…p+4",
//                                    "triangle": 0, "x": 3, "y": 5, "sample": 0,
//                                    "attribute": 0}}}}
//
// "name", "mismatches" and "worst" are absent if empty or 0. Digests have 16 hexadecimal digits. A
// worst error is as in records (record_json.h), without "case".

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cases/json_members.h"
#include "records/case_record.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const CaseRecordSet::value_type& one);
/// An array of such objects in key order. Reading refuses duplicate keys.
void write_value(nlohmann::json& to, const CaseRecordSet& records);
void read_value(const cases::JsonNode& node, CaseRecordSet& records);

/// Sets case index and name in the errors; files do not repeat them.
void name_case(WorstOfCase& worst, std::uint64_t index, const std::string& name);

/// Converts a digest to text and back.
std::string digest_text(std::uint64_t digest);
std::uint64_t digest_from_json(const cases::JsonNode& node);

/// Reads and writes a digest member of a record.
template <typename T>
struct DigestText {
  T& digest;

  friend void write_value(nlohmann::json& to, const DigestText& view) {
    cases::write_value(to, digest_text(view.digest));
  }
  friend void read_value(const cases::JsonNode& node, DigestText& view) {
    view.digest = digest_from_json(node);
  }
};
template <typename T>
DigestText(T&) -> DigestText<T>;
}  // namespace rastercheck::records
