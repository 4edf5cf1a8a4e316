#pragma once

// The table of a run: one row per law and backend.

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
  /// violated, but only by known defects of the driver
  known,
  /// held, but on too few cases to mean much (LawSummary::least_cases), or without reaching a
  /// required label
  thin,
  /// the law applied to no case, or no case had anything drawn correctly
  not_checked,
};

/// "held", "violated", "known", "thin", "not checked".
std::string_view to_string(LawVerdict verdict);

/// Sizes of errors over all kinds that have errors. Each kind counts in its own unit: scale ULP;
/// for depth, ULP of max(|n|, |f|).
struct SizeSummary {
  std::uint64_t values = 0;        ///< number of values that have an error
  Histogram histogram;             ///< histogram of |error|
  std::optional<Enclosure> worst;  ///< the largest |error|, in the narrowest double enclosure
  std::optional<WorstError> worst_at;
  std::optional<Enclosure> p99;  ///< the borders of the histogram bucket that holds the 99%
                                 ///< quantile
};

/// The quantiles that are shown and compared.
inline constexpr double kMedian = 0.5;
inline constexpr double kTail = 0.99;
inline constexpr double kFarTail = 0.999;

/// The largest possible error of a correctly rounded value, in scale ULP.
inline constexpr double kRoundingError = 0.5;

/// Precision of one kind's values against the exact triangle, in the kind's unit.
struct Precision {
  AttributeKind kind = AttributeKind::smooth;
  std::optional<Stratum> stratum;  ///< empty: all strata of the kind
  std::uint64_t values = 0;        ///< number of values that have an error; not 0
  Enclosure min;                   ///< the largest error below the exact value, 0 if none
  Enclosure max;                   ///< the largest error above the exact value, 0 if none
  /// Mean of the signed errors; empty if some were too large to be summed.
  std::optional<Enclosure> mean;
  /// Quantiles of the magnitudes, as the borders of the histogram buckets that hold them.
  std::optional<Enclosure> p50;
  std::optional<Enclosure> p99;
  std::optional<Enclosure> p999;
  /// Exact count of errors above kRoundingError. Other values may be misrounded as well: far below
  /// the triangle's largest value, float spacing is finer than the scale's.
  std::uint64_t misrounded = 0;
};

/// The mean part that one stage has in the errors of one kind, in the kind's unit.
struct StageMean {
  AttributeKind kind = AttributeKind::smooth;
  std::optional<Stratum> stratum;  ///< empty: all strata of the kind
  Stage stage = Stage::transform;
  std::uint64_t values = 0;  ///< values with an error part from that stage
  /// Mean of the parts' magnitudes; empty if some were too large to be summed.
  std::optional<Enclosure> mean;
};

struct LawSummary {
  std::string law;
  std::string backend;
  CaseCounts cases;
  std::uint64_t least_cases = 0;  ///< with fewer judged cases, "held" becomes "thin"
  Judged judged;
  Counts counts;
  ClassCounts classes;  ///< over all kinds, coverage included
  SizeSummary ideal;    ///< errors against the exact triangle
  SizeSummary excess;   ///< errors beyond what the contract leaves open
  /// For each kind with values: all values, then each stratum.
  std::vector<Precision> precision;
  /// For laws that split errors: for each kind all values, then each stratum, by stage.
  std::vector<StageMean> stages;
  Levels levels;  ///< number of decisions at each level of the oracle
  Power power;
  std::map<std::string, std::uint64_t> labels;
  std::map<std::string, std::uint64_t> known;                   ///< as in Record
  std::map<std::string, std::uint64_t> not_applicable_because;  ///< as in Record
  std::string skipped_by = {};  ///< the expectation list that skips the law; usually empty
  std::vector<UnreachedLabel> unreached;
  LawVerdict verdict = LawVerdict::not_checked;
};

/// Summarizes a run, in the order of its laws, then its backends. A pair without records is
/// `not_checked`.
std::vector<LawSummary> summarize(const Run& run);

/// Sums all laws' noticed defects per backend; leaves out backends whose drawings were never made
/// wrong on purpose.
std::map<std::string, Power> power_by_backend(const std::vector<LawSummary>& rows);

/// Returns how many of the requested cases must be judged for "held" to mean much: 20, or 2% if
/// that is more; all if fewer than 20 were requested.
std::uint64_t usual_least_cases(std::uint64_t asked);

/// The verdict of all rows together: violated if any is, not checked if none was checked, known or
/// thin if no checked row held.
LawVerdict verdict_of(const std::vector<LawSummary>& rows);

/// A known defect and its results in a run.
struct KnownSummary {
  std::string backend;
  KnownEntry entry;
  std::uint64_t cases = 0;  ///< sum of Record::known, including the entry's own case
  bool is_passed = false;   ///< passed unexpectedly
};

/// Returns the known defects of a run in the order of the run's lists.
std::vector<KnownSummary> known_defects(const Run& run);

/// Returns how many cases a law did not judge, and why, the most frequent reason first.
std::vector<std::pair<std::uint64_t, std::string>> reasons_of(const LawSummary& row);

/// Returns why a law checked nothing: the list that skips it, else the reason for most cases; empty
/// if cases were checked or no reason is known.
std::string why_not_checked(const LawSummary& row);

/// Says, for a thin row, on how many cases the law held and which label was not reached.
std::string thin_words(const LawSummary& row);

/// "3 properties held on fewer than 20 cases; 1 property held without reaching a required label";
/// empty if no row is thin.
std::string thin_sentence(const std::vector<LawSummary>& rows);

}  // namespace rastercheck::records
