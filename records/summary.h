#pragma once

// What a table says of a run: one row per law and backend.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "records/judged.h"
#include "records/run.h"

namespace rastercheck::records {

enum class LawVerdict {
  held,
  violated,
  /// violated, but only in ways that are known of the driver
  known,
  /// held, but on too few cases to say much (LawSummary::least_cases), or with a label that had to
  /// be reached and was not
  thin,
  /// no case that the law says anything of, or nothing drawn rightly in any
  not_checked,
};

/// "held", "violated", "known", "thin", "not checked".
std::string_view to_string(LawVerdict verdict);

/// How large errors were, over all kinds that have errors, each in its own unit: scale ULP; of
/// depth ULP of max(|n|, |f|).
struct SizeSummary {
  std::uint64_t values = 0;        ///< that have an error
  Histogram histogram;             ///< of their magnitudes
  std::optional<Enclosure> worst;  ///< the largest magnitude, as narrow as doubles get
  std::optional<WorstError> worst_at;
  std::optional<Enclosure> p99;  ///< the borders of the histogram bucket that holds it
};

/// The quantiles that are shown and compared.
inline constexpr double kMedian = 0.5;
inline constexpr double kTail = 0.99;
inline constexpr double kFarTail = 0.999;

/// No correctly rounded value is off by more, in scale ULP.
inline constexpr double kRoundingError = 0.5;

/// How precise the values of one kind were against the exact triangle, in the kind's own unit.
struct Precision {
  AttributeKind kind = AttributeKind::smooth;
  std::optional<Stratum> stratum;  ///< nothing: all of the kind
  std::uint64_t values = 0;        ///< that have an error; not 0
  Enclosure min;                   ///< the largest error below the exact value, 0 without one
  Enclosure max;                   ///< and above it
  /// Of the signed errors; nothing where some were too large to be summed.
  std::optional<Enclosure> mean;
  /// Of the magnitudes: the borders of the histogram buckets that hold them.
  std::optional<Enclosure> p50;
  std::optional<Enclosure> p99;
  std::optional<Enclosure> p999;
  /// Off by more than kRoundingError, exactly counted. Others may be misrounded, too: a value far
  /// below the largest of its triangle has a finer spacing than the scale's.
  std::uint64_t misrounded = 0;
};

/// How much of the errors of one kind one stage made, in the kind's own unit.
struct StageMean {
  AttributeKind kind = AttributeKind::smooth;
  std::optional<Stratum> stratum;  ///< nothing: all of the kind
  Stage stage = Stage::transform;
  std::uint64_t values = 0;  ///< whose errors have a part of that stage
  /// Of the magnitudes of those parts; nothing where some were too large to be summed.
  std::optional<Enclosure> mean;
};

struct LawSummary {
  std::string law;
  std::string backend;
  CaseCounts cases;
  std::uint64_t least_cases = 0;  ///< judged on fewer it has held thinly
  Judged judged;
  Counts counts;
  ClassCounts classes;  ///< over all kinds, coverage included
  SizeSummary ideal;    ///< against the exact triangle
  SizeSummary excess;   ///< beyond what the contract leaves open
  /// Of each kind that has values: all of them, then its strata.
  std::vector<Precision> precision;
  /// Of laws that split errors: of each kind all of them, then its strata, each by stage.
  std::vector<StageMean> stages;
  Levels levels;  ///< of the oracle, by what each decided
  Power power;
  std::map<std::string, std::uint64_t> labels;
  std::map<std::string, std::uint64_t> known;                   ///< id → cases violated so
  std::map<std::string, std::uint64_t> not_applicable_because;  ///< as of Record
  std::string skipped_by = {};  ///< the expectation list that had it left out; mostly empty
  std::vector<UnreachedLabel> unreached;
  LawVerdict verdict = LawVerdict::not_checked;
};

/// In the order of the run's laws, and of each its backends. A pair without records was not
/// checked.
std::vector<LawSummary> summarize(const Run& run);

/// Adds up what all laws noticed on each backend; only backends that were asked.
std::map<std::string, Power> power_by_backend(const std::vector<LawSummary>& rows);

/// Gives on how many of the cases asked for a law has to be judged for "held" to say much: 20, or
/// 2% of them where that is more; all of fewer than 20.
std::uint64_t usual_least_cases(std::uint64_t asked);

/// Of all rows together: violated where one is, not checked where none was checked, known or thin
/// where none of those that were checked held.
LawVerdict verdict_of(const std::vector<LawSummary>& rows);

/// A known defect, and what a run found of it.
struct KnownSummary {
  std::string backend;
  KnownEntry entry;
  std::uint64_t cases = 0;  ///< that are violated so, its own among them
  bool is_passed = false;   ///< unexpectedly
};

/// In the order of the run's lists.
std::vector<KnownSummary> known_defects(const Run& run);

/// Why cases were not judged by a law, and how many, the most frequent reason first.
std::vector<std::pair<std::uint64_t, std::string>> reasons_of(const LawSummary& row);

/// Why a law checked nothing: what it says of most cases; empty where cases were checked, or there
/// were none.
std::string why_not_checked(const LawSummary& row);

/// Says of a thin row on how many cases it held, and what label it did not reach.
std::string thin_words(const LawSummary& row);

/// "3 properties held on fewer than 20 cases"; empty where none did.
std::string thin_sentence(const std::vector<LawSummary>& rows);

}  // namespace rastercheck::records
