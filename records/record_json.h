#pragma once

// Records as JSON:
//
//   [{"property": "…", "backend": "cpu", "attribute_kind": "smooth", "stratum": "…",
//     "cases": {"checked": 7, "not_applicable": 0, "violations": 1},
//     "counts": {"required": 9, "forbidden": 90, "permitted": 1, "undecided": 0},
//     "classes": {"correct": 8, "beyond bound": 1, …},
//     "excess": {"histogram": {"buckets": [[0, 5], [155, 4]], "non_finite": 0},
//                "most_negative": {"error": [-0.5, -0.5], "exact": "84/5",
//                                  "actual": "0x1.0cccccp+4", "case": {"index": 3, "name": "…"},
//                                  "triangle": 0, "x": 3, "y": 5, "sample": 0, "attribute": 0},
//                "sum": {"lo": "-8589934592", "hi": "-8589934592", "count": 9, "beyond": 0}},
//     "ideal": {"histogram": {"buckets": [[0, 9]], "non_finite": 0}},
//     "strata": {"sliver": {as "ideal"}, "ordinary": {as "ideal"}},
//     "stages": {"sliver": {"set-up": {as "sum"}, "rounding": {as "sum"}}},
//     "labels": {"tie": 4}, "decided_at": {"samples by filter": 100}}]
//
// The array is ordered by key. A bucket is [its number (histogram.h), its count]; empty ones are
// left out. "most_negative" and "most_positive" are absent if no such error exists, and "attribute"
// is absent for depth. The doubles of "error" are numbers in decimals that read back as the same
// double (nlohmann writes no more than 17 digits, without asking the locale); an infinite end is
// "inf" or "-inf". A "sum" lies from "lo" to "hi" times 2^-32, whole numbers of up to 127 bits as
// decimal text; "count" is the number of errors that were summed, and "beyond" the number that were
// too large to be summed (signed_sum.h). "decided_at" holds the Levels, by question and answering
// level; levels without an answer are left out. Means, quantiles and rates follow from these and
// are not written. Empty "sum", "strata" and "stages" are left out; older files lack them as well.
// "stages" sums the magnitudes of the parts of errors by stage (judgement.h). "cases" has "known"
// if some cases were violated in known ways only; "known": {"llvmpipe-3": 5} names the entries
// (known.h). The reasons why a law does not apply to cases are in "not_applicable_because": {"its
// contract lacks 8 samples": 7}. "power" counts drawings that were made wrong, and how many of
// these were noticed: {"values NaN": {"drawings": 4, "noticed": 4}}. "not_judged": {"not promised":
// 3} counts fragments or values that were drawn but not judged. "known" (in both places),
// "not_applicable_because", "power" and "not_judged" are absent if empty or 0. The float32 of
// "actual" is a hex float, as in all files. Objects list their keys alphabetically, so that equal
// records give equal bytes.

#include <nlohmann/json_fwd.hpp>

#include "cases/json_members.h"
#include "records/record.h"

namespace rastercheck::records {

void write_value(nlohmann::json& to, const RecordSet::value_type& one);
/// The records as a JSON array. Texts are UTF-8 and every `actual` is finite.
void write_value(nlohmann::json& to, const RecordSet& records);
/// Refuses unknown and missing keys, numbers that their members cannot hold exactly, and duplicate
/// record keys.
void read_value(const cases::JsonNode& node, RecordSet& records);

/// Parts of records that other files use as well: a "histogram", a "sum", counts of noticed
/// defects.
void write_value(nlohmann::json& to, const Histogram& histogram);
void read_value(const cases::JsonNode& node, Histogram& histogram);
void write_value(nlohmann::json& to, const SignedSum& sum);
void read_value(const cases::JsonNode& node, SignedSum& sum);
void write_value(nlohmann::json& to, const Noticed& noticed);
void read_value(const cases::JsonNode& node, Noticed& noticed);

/// A worst error without its "case", for files that give the case elsewhere.
void write_value(nlohmann::json& to, const WorstError& worst);
void read_value(const cases::JsonNode& node, WorstError& worst);

}  // namespace rastercheck::records
