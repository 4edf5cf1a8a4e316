#pragma once

// A baseline's section held against another (gate/compare.h): what grew, what fell, and where. As
// plain data. An entry with both worse and better figures is worse.

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

/// A figure of an entry that is compared. Of `checked` and `noticed` less is worse, of all others
/// more.
enum class Figure {
  violations,  ///< cases violated in ways that are not known
  known,       ///< cases violated in known ways only
  checked,     ///< cases that the law says something of: others are not looked at any more
  mismatches,  ///< of one class, FigureChange::fragment_class
  not_judged,  ///< the share of fragments, or values, that nothing was said of
  noticed,     ///< of as many drawings that were made wrong on purpose
  worst,       ///< the largest magnitude
  misrounded,  ///< the share of values off by more than kRoundingError
  p999,
  p99,
  p50,
  /// Cases whose own worst grew, of kind `coverage` those of which more came out wrong or that are
  /// violated and were not: what grows where it is not the largest of all, or where another case
  /// makes up for it in the sum.
  grown_cases,
};
constexpr auto names_of(Figure /*type*/) {
  return std::to_array<std::string_view>({"violations", "known violations", "cases checked",
                                          "mismatches", "not judged", "defects noticed", "worst",
                                          "misrounded", "p99.9", "p99", "p50", "cases that grew"});
}
constexpr std::string_view to_string(Figure figure) { return cases::name_of(figure); }

/// A figure's value. What is a size (worst, p50, p99, p99.9: the borders of the bucket) has `size`,
/// a count `count`, a share `count` of `of`.
struct FigureValue {
  std::optional<Enclosure> size;
  std::uint64_t count = 0;
  std::uint64_t of = 0;
  bool operator==(const FigureValue&) const = default;
};

struct FigureChange {
  Figure figure = Figure::worst;
  /// Of mismatches.
  FragmentClass fragment_class = FragmentClass::correct;
  Change change = Change::same;  ///< better or worse
  FigureValue before;
  FigureValue after;
  bool operator==(const FigureChange&) const = default;
};

/// Of a stage of one entry: the mean magnitude of its part of errors, in the kind's unit, and its
/// share of the sum of all parts, 0…1, a number to show. Means and shares are absent where there
/// are none (SignedSum::mean).
struct StageChange {
  Stage stage = Stage::transform;
  std::optional<Enclosure> mean_before;
  std::optional<Enclosure> mean_after;
  std::optional<double> share_before;
  std::optional<double> share_after;
  bool operator==(const StageChange&) const = default;
};

/// How many times larger its part has become, a number to order by: parts of different stages
/// differ by powers of ten, as where values come from snapped vertices. Infinite where there was
/// none.
double growth_of(const StageChange& change);

struct EntryChange {
  EntryKey key;
  Change change = Change::same;
  std::vector<FigureChange> figures;  ///< that changed, in the order of Figure
  EntryFigures before;                ///< empty of a new one
  EntryFigures after;                 ///< empty of one that is gone
  std::vector<StageChange> stages;    ///< all, in their order; of laws that split errors
  /// The stage whose part grew most (growth_of); nothing where none did, and of a backend that
  /// tells of no stages.
  std::optional<Stage> grown_stage;
  /// Why a policy allows that it is worse (gate/policy.h).
  std::optional<std::string> allowed_because = std::nullopt;
  bool operator==(const EntryChange&) const = default;
};

/// A case whose error of one kind and stratum grew, of which more came out wrong, or that is
/// violated and was not.
struct CaseGrowth {
  std::string law;
  Origin origin = Origin::random;
  std::uint64_t index = 0;
  std::string name;  ///< of a case of the corpus
  /// Of the error that grew most; nothing where more came out wrong and no error grew.
  std::optional<AttributeKind> kind = std::nullopt;
  std::optional<Stratum> stratum = std::nullopt;
  /// Nothing: no error but 0, or no value of that kind and stratum was judged; which of the two is
  /// not kept.
  std::optional<WorstError> before = std::nullopt;
  std::optional<WorstError> after = std::nullopt;
  std::uint64_t mismatches_before = 0;
  std::uint64_t mismatches_after = 0;
  /// Both `held` where what they were then is not known (are_outcomes_known).
  CaseOutcome outcome_before = CaseOutcome::held;
  CaseOutcome outcome_after = CaseOutcome::held;
  bool operator==(const CaseGrowth&) const = default;
};

struct Comparison {
  BaselineKey key;      ///< of the baseline's section
  std::string backend;  ///< of the current one: as the run names it
  Taken before;
  Taken after;
  Plan plan;                         ///< the current section's; what was frozen is the same of both
  std::vector<EntryChange> entries;  ///< in the order of their keys
  /// By how much grew, the most first: outcomes before mismatches before errors, and of these such
  /// as there were before.
  std::vector<CaseGrowth> growths;
  std::uint64_t grown_cases = 0;            ///< of which `growths` are the first
  std::uint64_t changed_cases = 0;          ///< what was found of them is not the same, to the bit
  std::uint64_t compared_cases = 0;         ///< that both have
  std::vector<std::string> gone_laws = {};  ///< run then and not now
  std::vector<std::string> new_laws = {};
  bool operator==(const Comparison&) const = default;
};

/// What became of a policy: one line each, for those who keep it.
struct PolicyReview {
  std::vector<std::string> expired;  ///< allow nothing any more
  std::vector<std::string> unused;   ///< allow nothing that is worse, and may go
  bool operator==(const PolicyReview&) const = default;
};

/// How many of its entries changed so; of the worse ones those that no policy allows with
/// `refused`.
std::uint64_t count_of(const Comparison& comparison, Change change);
std::uint64_t refused(const Comparison& comparison);
std::uint64_t refused(const std::vector<Comparison>& comparisons);

/// "worst", "missing" (of mismatches the class).
std::string_view figure_name(const FigureChange& change);

}  // namespace rastercheck::records
