#pragma once

// The baseline file: parts for people come before parts that are only compared.
//
//   {
//     "format": "rastercheck-baseline",
//     "version": 2,
//     "sections": [{
//       "backend": "cpu", "architecture": "x86_64",
//       "instruction_set": "avx2", "compiler": "GNU 12.2.0",   only if the section is so specific
//       "records_version": 3, "rules_version": 1,
//       "plan": {…},   plan_json.h
//       "taken": {"backend": "cpu", "version": "0.1.0", "commit": "…", "instruction_set": "avx512",
//                 "compiler": "GNU 12.2.0"},
//       "approvals": [{"reason": "…", "version": "…", "commit": "…", "changes": ["…"]}],
//       "entries": [
//         {"property": "…", "kind": "coverage", "cases": {"checked": 9, "not_applicable": 1},
//          "classes": {"correct": 800}},
//         {"property": "…", "kind": "smooth", "classes": {"correct": 800}, "worst": [0.49, 0.49],
//          "histogram": {…}, "stages": {"rounding": {…}}},
//         {"property": "…", "kind": "smooth", "stratum": "sliver", "worst": […], …}],
//       "properties": [{"property": "…", "cases": 418, "digest": "0123456789abcdef"}],
//       "corpus": [[0, "name of the case"]],
//       "cases": [{"property": "…", "cases": [{"corpus": 3, "found": "0123456789abcdef",
//                                              "outcome": "violated", "mismatches": 1,
//                                              "worst": {"smooth": {"sliver": {…}}}}]}]
//     }]
//   }
//
// Each entry, law, case and approval takes one line, in the order of the keys. Classes without a
// fragment, empty histograms, a worst error of 0 and other empty or zero members are left out.
// "histogram" and the sums of "stages" are as in records (records/record_json.h), "worst" of a case
// as in case records (records/case_record_json.h). A case is numbered within "corpus" or within
// "random". Not shown: an entry's "power" and "not_judged", and a section's "specimens"
// (records/specimen_json.h).

#include <string>
#include <string_view>

#include "cases/error.h"
#include "records/baseline.h"

namespace rastercheck::records {

/// Formats the file. Bytes that are not UTF-8 become U+FFFD.
std::string to_json(const Baseline& baseline);

/// Refuses unknown and missing keys, duplicate keys of sections, entries, laws or cases, and
/// numbers that their members cannot hold exactly. `file` names the source in errors.
Result<Baseline> parse_baseline(std::string_view text, const std::string& file);

/// Parses a file, or standard input for "-".
Result<Baseline> read_baseline(const std::string& file);

}  // namespace rastercheck::records
