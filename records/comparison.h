#pragma once

// Two baseline sections compared (gate/compare.h): what grew, what fell, and where. Plain data. An
// entry with both worse and better figures counts as worse.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/names.h"
#include "records/baseline.h"

namespace rastercheck::records {

enum class Change { same, better, worse, appeared, gone };
constexpr auto names_of(Change /*type*/) {
  return std::to_array<std::string_view>({"same", "better", "worse", "new", "gone"});
}
constexpr std::string_view to_string(Change change) { return cases::name_of(change); }

/// A compared figure of an entry. Less is worse for `checked` and `noticed`, more is worse for all
/// others.
enum class Figure {
  violations,  ///< cases violated in at least one way that is not known
  known,       ///< cases violated in known ways only
  checked,     ///< cases to which the law applies
  mismatches,  ///< fragments or values of one class, FigureChange::fragment_class
  not_judged,  ///< the share of fragments or values that were not judged
  noticed,     ///< wrong drawings that were noticed, out of those made wrong on purpose
  worst,       ///< the largest magnitude
  misrounded,  ///< the share of values with an error above kRoundingError
  p999,
  p99,
  p50,
  /// Cases whose own worst error grew; for kind `coverage`, cases with more mismatches or newly
  /// violated. Shows growth below the overall worst, and growth that another case offsets in the
  /// sum.
  grown_cases,
};
constexpr auto names_of(Figure /*type*/) {
  return std::to_array<std::string_view>({"violations", "known violations", "cases checked",
                                          "mismatches", "not judged", "defects noticed", "worst",
                                          "misrounded", "p99.9", "p99", "p50", "cases that grew"});
}
constexpr std::string_view to_string(Figure figure) { return cases::name_of(figure); }

/// A figure's value. Sizes use `size`: worst, and p50, p99 and p99.9 as the borders of their
/// bucket. Counts use `count`, shares are `count` out of `of`.
struct FigureValue {
  std::optional<Enclosure> size;
  std::uint64_t count = 0;
  std::uint64_t of = 0;
  bool operator==(const FigureValue&) const = default;
};

struct FigureChange {
  Figure figure = Figure::worst;
  /// The class of the mismatches; only for figure `mismatches`.
  FragmentClass fragment_class = FragmentClass::correct;
  Change change = Change::same;  ///< better or worse
  FigureValue before;
  FigureValue after;
  bool operator==(const FigureChange&) const = default;
};

/// A stage's part of one entry's errors: the mean |part| in the kind's unit, and the share of the
/// sum of all parts, 0…1, for display only. Means and shares are absent if none exist
/// (SignedSum::mean).
struct StageChange {
  Stage stage = Stage::transform;
  std::optional<Enclosure> mean_before;
  std::optional<Enclosure> mean_after;
  std::optional<double> share_before;
  std::optional<double> share_after;
  bool operator==(const StageChange&) const = default;
};

/// Returns the factor by which the stage's part grew, for ordering only: parts of different stages
/// differ by powers of ten, for instance if values come from snapped vertices. Infinite if the part
/// was 0 before and is not any more.
double growth_of(const StageChange& change);

struct EntryChange {
  EntryKey key;
  Change change = Change::same;
  std::vector<FigureChange> figures;  ///< only the changed figures, in the order of Figure
  EntryFigures before;                ///< empty for a new entry
  EntryFigures after;                 ///< empty for an entry that is gone
  std::vector<StageChange> stages;    ///< all, in order; only for laws that split errors
  /// The stage whose part grew most (growth_of); empty if none grew or the backend reports no
  /// stages.
  std::optional<Stage> grown_stage;
  /// Why a policy allows this entry to be worse (gate/policy.h).
  std::optional<std::string> allowed_because = std::nullopt;
  bool operator==(const EntryChange&) const = default;
};

/// A case whose error of one kind and stratum grew, that has more mismatches, or that is newly
/// violated.
struct CaseGrowth {
  std::string law;
  Origin origin = Origin::random;
  std::uint64_t index = 0;
  std::string name;  ///< the case's name; only for a corpus case
  /// Kind of the error that grew most; empty if mismatches grew but no error did.
  std::optional<AttributeKind> kind = std::nullopt;
  std::optional<Stratum> stratum = std::nullopt;
  /// Empty if every error was 0, or if no value of that kind and stratum was judged; the baseline
  /// does not tell the two apart.
  std::optional<WorstError> before = std::nullopt;
  std::optional<WorstError> after = std::nullopt;
  std::uint64_t mismatches_before = 0;
  std::uint64_t mismatches_after = 0;
  /// Both outcomes are `held` if the earlier outcomes are unknown (are_outcomes_known).
  CaseOutcome outcome_before = CaseOutcome::held;
  CaseOutcome outcome_after = CaseOutcome::held;
  bool operator==(const CaseGrowth&) const = default;
};

struct Comparison {
  BaselineKey key;      ///< key of the baseline's section
  std::string backend;  ///< backend of the current section, as the run names it
  Taken before;
  Taken after;
  Plan plan;                         ///< the current section's; frozen() is equal for both
  std::vector<EntryChange> entries;  ///< in the order of their keys
  /// Largest growth first: outcomes, then mismatches, then errors; among errors, those whose
  /// baseline value is known come first.
  std::vector<CaseGrowth> growths;
  std::uint64_t grown_cases = 0;     ///< number of all cases that grew; `growths` holds the first
                                     ///< of them
  std::uint64_t changed_cases = 0;   ///< cases whose results differ in at least one bit
  std::uint64_t compared_cases = 0;  ///< cases present in both sections
  std::vector<std::string> gone_laws = {};  ///< laws that were run for the baseline but not now
  std::vector<std::string> new_laws = {};
  bool operator==(const Comparison&) const = default;
};

/// The state of a policy's entries, one line each, for the policy's maintainers.
struct PolicyReview {
  std::vector<std::string> expired;  ///< entries no longer in force
  std::vector<std::string> unused;   ///< entries that match nothing that is worse, and may be
                                     ///< removed
  bool operator==(const PolicyReview&) const = default;
};

/// count_of() counts the entries with that change; refused() counts worse entries that no policy
/// allows.
std::uint64_t count_of(const Comparison& comparison, Change change);
std::uint64_t refused(const Comparison& comparison);
std::uint64_t refused(const std::vector<Comparison>& comparisons);

/// "worst"; for mismatches the class: "missing".
std::string_view figure_name(const FigureChange& change);

}  // namespace rastercheck::records
