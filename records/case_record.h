#pragma once

// What single cases of a run gave, as plain data: of runs that keep it (Run::cases), so that a
// later run can be held against them case by case.
//
// Only the cases that every run of the same seed has are kept: those of the corpus and random ones,
// not saved counterexamples, scenes and known defects.

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "records/counterexample.h"
#include "records/judgement.h"

namespace rastercheck::records {

/// Which case of which law on which backend.
struct CaseKey {
  std::string law;      ///< the property's id
  std::string backend;  ///< as given on the command line
  Origin origin = Origin::random;
  std::uint64_t index = 0;  ///< of its law and seed, or in the corpus
  auto operator<=>(const CaseKey&) const = default;
};

/// What became of a case.
enum class CaseOutcome { held, violated, known, not_applicable };
constexpr auto names_of(CaseOutcome /*type*/) {
  return std::to_array<std::string_view>({"held", "violated", "known", "not applicable"});
}
constexpr std::string_view to_string(CaseOutcome outcome) { return cases::name_of(outcome); }

/// The largest error against the exact triangle of each kind and stratum of fragments, by
/// magnitude, and of equally large ones the negative. Only where there is one but 0. Case index and
/// name of a WorstError are those of the case.
using WorstOfCase = std::map<AttributeKind, std::map<Stratum, WorstError>>;

struct CaseRecord {
  std::string name;     ///< of the case; empty where it has none
  std::string stratum;  ///< of the record that it is counted in (RecordKey::stratum)
  CaseOutcome outcome = CaseOutcome::held;
  std::uint64_t source_digest = 0;  ///< of the case file
  /// Of all that was judged: outcome, labels, counts, classes, errors with their places and sums.
  /// Not of what the oracle took to find it out.
  std::uint64_t found_digest = 0;
  /// Samples and values that came out wrong: all of another class than correct.
  std::uint64_t mismatches = 0;
  WorstOfCase worst;
  bool operator==(const CaseRecord&) const = default;
};

using CaseRecordSet = std::map<CaseKey, CaseRecord>;

}  // namespace rastercheck::records
