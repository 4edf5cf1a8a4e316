#pragma once

// The results of a run's single cases, as plain data. A run that keeps these results (Run::cases)
// can be compared with a later run case by case.
//
// Keeps only cases that every run with the same seed has: corpus and random cases, not saved
// counterexamples, scenes or known defects.

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "records/counterexample.h"
#include "records/judgement.h"

namespace rastercheck::records {

/// Identifies one case of one law on one backend.
struct CaseKey {
  std::string law;      ///< the property's id
  std::string backend;  ///< as given on the command line
  Origin origin = Origin::random;
  std::uint64_t index = 0;  ///< among the cases of the law and seed, or in the corpus
  auto operator<=>(const CaseKey&) const = default;
};

/// The outcome of a case.
enum class CaseOutcome { held, violated, known, not_applicable };
constexpr auto names_of(CaseOutcome /*type*/) {
  return std::to_array<std::string_view>({"held", "violated", "known", "not applicable"});
}
constexpr std::string_view to_string(CaseOutcome outcome) { return cases::name_of(outcome); }

/// The largest |error| against the exact triangle for each kind and stratum of fragments; of two
/// equally large errors, the negative one. Absent if every error is 0. Case index and name of a
/// WorstError are those of the case.
using WorstOfCase = std::map<AttributeKind, std::map<Stratum, WorstError>>;

struct CaseRecord {
  std::string name;     ///< the case's name; empty if unnamed
  std::string stratum;  ///< stratum of the record that counts the case (RecordKey::stratum)
  CaseOutcome outcome = CaseOutcome::held;
  std::uint64_t source_digest = 0;  ///< digest of the case file
  /// Digest of everything judged: outcome, labels, counts, classes, errors with their places and
  /// sums; excludes the oracle's effort.
  std::uint64_t found_digest = 0;
  /// Counts wrong samples and values: every class except `correct`.
  std::uint64_t mismatches = 0;
  WorstOfCase worst;
  bool operator==(const CaseRecord&) const = default;
};

using CaseRecordSet = std::map<CaseKey, CaseRecord>;

}  // namespace rastercheck::records
