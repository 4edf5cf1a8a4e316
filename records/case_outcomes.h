#pragma once

// Which cases of a run were right on which backend. Kept by runs of several backends, so that
// reports can show them side by side (side_by_side.h).
//
// Stores ranges of case numbers, not a result for each case (case_record.h), because checkpoints
// contain them and should stay small. Merging is a union of sets, so it gives the same result in
// any order and for any split of the cases.
//
// Keeps corpus and random cases, and leaves out cases that the law does not apply to or that were
// not drawn because the backend was given up.

#include <compare>
#include <map>
#include <optional>
#include <string>

#include "cases/case.h"
#include "records/counterexample.h"
#include "records/index_set.h"

namespace rastercheck::records {

/// Identifies one law's cases from one origin on one backend.
struct OutcomeKey {
  std::string law;      ///< the property's id
  std::string backend;  ///< as given on the command line
  Origin origin = Origin::random;
  auto operator<=>(const OutcomeKey&) const = default;
};

/// Judged cases by outcome; no case is in two of the first three sets.
struct CaseOutcomes {
  IndexSet right;
  IndexSet wrong;
  IndexSet known;  ///< wrong, but only by known defects (known.h)
  /// For each earlier backend of the plan: the numbers of the judged cases for which that backend
  /// got a different case, because cases are made to fit what a backend can draw.
  std::map<std::string, IndexSet> unlike;
  bool operator==(const CaseOutcomes&) const = default;
};

using CaseOutcomeSet = std::map<OutcomeKey, CaseOutcomes>;

/// All judged cases.
IndexSet judged_of(const CaseOutcomes& outcomes);

/// Adds `from` to `into`.
void merge(CaseOutcomeSet& into, const CaseOutcomeSet& from);

/// A case on which two backends differ: the first one of its law for which the law holds on the
/// backend `right` and fails on another backend.
struct Difference {
  /// The case, with `found`: law, the backend that is wrong, seed and index, but no verdict.
  cases::Case source;
  std::string right;
  Origin origin = Origin::random;
  bool operator==(const Difference&) const = default;
};

/// Returns the file of a difference within the run's folder:
/// "differences/LAW-BACKEND-wrong-BACKEND-right.json", each part as by file_word().
std::string file_of(const Difference& difference);

}  // namespace rastercheck::records
