#pragma once

// The findings of a part of a campaign. Findings merge exactly, in any order and for any split of
// the work.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/case_outcomes.h"
#include "records/case_record.h"
#include "records/counterexample.h"
#include "records/known.h"
#include "records/record.h"

namespace rastercheck::properties {

/// The laws that judge the plain drawing of an unchanged case.
inline constexpr std::string_view kCoverageLaw = "coverage-obeys-the-contract";
inline constexpr std::string_view kValuesLaw = "values-stay-within-the-bound";

/// The findings of a part of a campaign.
struct Findings {
  records::RecordSet records;
  /// Only for campaigns that keep each case's result.
  std::optional<records::CaseRecordSet> cases = std::nullopt;
  /// Only for campaigns on several backends.
  std::optional<records::CaseOutcomeSet> outcomes = std::nullopt;
  /// One per (law, backend, verdict, kind, condition), the first by origin and index. For a backend
  /// that hangs, a single one for all laws.
  std::vector<records::Counterexample> counterexamples;
  /// In order, each once.
  std::vector<records::UnexpectedPass> unexpected;
  /// A fault of the oracle or the harness, one line; if set, the rest is worthless.
  std::optional<std::string> fault;
  bool operator==(const Findings&) const = default;
};

/// Adds an unexpected pass.
void keep(Findings& findings, records::UnexpectedPass pass);

/// Adds `from`; if both have a fault, the first stays.
void merge(Findings& into, Findings from);

/// Adds a counterexample (its case must have `found`), unless an earlier one failed in the same
/// way.
void keep(Findings& findings, records::Counterexample counterexample);

/// Returns the index of the counterexample to read first. Prefers laws that judge a plain drawing;
/// then failures that rounding does not explain; then the smallest case. Rounding explains wrong
/// coverage less than 1/1024 pixel from the boundary, but not on it.
std::size_t first_to_read(const std::vector<records::Counterexample>& all);

/// True if keep() would add a case with this failure; check this before building the
/// counterexample.
bool is_kept(const Findings& findings, const cases::Found& found, records::Origin origin,
             const std::string& name);

}  // namespace rastercheck::properties
