#pragma once

// The baseline file: what is read by people comes before what only is compared.
//
//   {
//     "format": "rastercheck-baseline",
//     "version": 2,
//     "sections": [{
//       "backend": "cpu", "architecture": "x86_64",
//       "instruction_set": "avx2", "compiler": "GNU 12.2.0",   only of a section so specific
//       "records_version": 3, "rules_version": 1,
//       "plan": {"seed": 1, "cases_per_law": 100, "properties": ["*edge*"]},   plan_json.h
//       "taken": {"backend": "cpu", "version": "0.1.0", "commit": "…", "instruction_set": "avx512",
//                 "compiler": "GNU 12.2.0"},
//       "approvals": [{"reason": "…", "version": "…", "commit": "…", "changes": ["…"]}],
//       "entries": [
//         {"law": "…", "kind": "coverage", "cases": {"checked": 9, "not_applicable": 1,
//          "violations": 0, "known": 0}, "classes": {"correct": 800}},
//         {"law": "…", "kind": "smooth", "classes": {"correct": 800}, "worst": [0.49, 0.49],
//          "histogram": {…}, "stages": {"rounding": {…}}},
//         {"law": "…", "kind": "smooth", "stratum": "sliver", "worst": […], …}],
//       "laws": [{"law": "…", "cases": 418, "digest": "0123456789abcdef"}],
//       "corpus": [[0, "name of the case"]],
//       "cases": [{"law": "…", "cases": [{"corpus": 3, "found": "0123456789abcdef",
//                                         "outcome": "violated", "mismatches": 1,
//                                         "worst": {"smooth": {"sliver": {…}}}}]}]
//     }]
//   }
//
// An entry, a law, a case and an approval take a line each, in the order of their keys. Classes
// without a fragment, empty histograms, a worst error of 0 and all else that is empty or 0 are left
// out. "histogram" and the sums of "stages" are as in records (records/record_json.h), "worst" of a
// case as in case records (records/case_record_json.h). A case is numbered within its "corpus" or
// of the "random" ones.

#include <string>
#include <string_view>

#include "cases/error.h"
#include "records/baseline.h"

namespace rastercheck::records {

/// The file's text. Texts that are not UTF-8 come out with U+FFFD.
std::string to_json(const Baseline& baseline);

/// Refuses unknown and missing keys, two sections, entries, laws or cases of one key, and numbers
/// that their members cannot hold exactly. `file` names the source in errors.
Result<Baseline> parse_baseline(std::string_view text, const std::string& file);

/// The same from a file, or from standard input for "-".
Result<Baseline> read_baseline(const std::string& file);

}  // namespace rastercheck::records
