#pragma once

// What parts of a campaign found, and how it comes together: exactly, in whatever order and however
// the work was split.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/case_record.h"
#include "records/counterexample.h"
#include "records/known.h"
#include "records/record.h"

namespace rastercheck::properties {

/// The laws that speak of whatever is drawn of a case as it stands.
inline constexpr std::string_view kCoverageLaw = "coverage-obeys-the-contract";
inline constexpr std::string_view kValuesLaw = "values-stay-within-the-bound";

/// What part of a campaign found.
struct Findings {
  records::RecordSet records;
  /// Of campaigns that keep what each case gave; else nothing.
  std::optional<records::CaseRecordSet> cases = std::nullopt;
  /// By (law, backend, verdict, kind, condition), one of each: the first by origin and index; of a
  /// backend that hangs one whatever the law.
  std::vector<records::Counterexample> counterexamples;
  /// In order, each once.
  std::vector<records::UnexpectedPass> unexpected;
  /// A fault of the oracle or the harness: the rest is worth nothing. One line.
  std::optional<std::string> fault;
  bool operator==(const Findings&) const = default;
};

/// Adds a pass.
void keep(Findings& findings, records::UnexpectedPass pass);

/// Adds `from`; of two faults the first stays.
void merge(Findings& into, Findings from);

/// Adds a counterexample, whose case has `found`, unless there is one that failed in the same way
/// and comes before it.
void keep(Findings& findings, records::Counterexample counterexample);

/// Which of some counterexamples to look at first: one of a law that speaks of the case as it
/// stands, if there is one; of these, or of all, one that is not of rounding (coverage alone,
/// and all of it less than 1/1024 pixel beside the boundary); and of these the smallest.
std::size_t first_to_read(const std::vector<records::Counterexample>& all);

/// Whether keep() would add a case that failed so: what to ask before it is put together.
bool is_kept(const Findings& findings, const cases::Found& found, records::Origin origin,
             const std::string& name);

}  // namespace rastercheck::properties
