#pragma once

// The accuracy table: how exactly different rasterizers draw the same cases, one row for each.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/error.h"
#include "records/judgement.h"
#include "records/summary.h"

namespace rastercheck::records {

/// The properties whose judgements the table is made of.
inline constexpr std::string_view kCoverageLaw = "coverage-obeys-the-contract";
inline constexpr std::string_view kValuesLaw = "values-stay-within-the-bound";

/// Errors of values of one kind, whatever the contract leaves open (ErrorStatistics::ideal), in the
/// kind's unit.
struct AccuracyFigure {
  AttributeKind kind = AttributeKind::smooth;
  std::optional<Stratum> stratum;  ///< empty: all strata
  std::uint64_t values = 0;        ///< not 0
  double worst = 0;                ///< the largest magnitude
  double p99 = 0;  ///< the 99 % quantile, as the upper border of the histogram's bucket
  bool operator==(const AccuracyFigure&) const = default;
};

struct AccuracyRow {
  std::string backend;      ///< as given on the command line
  std::string drawn_by;     ///< name and version
  std::string date;         ///< of the measurement, YYYY-MM-DD
  std::uint64_t asked = 0;  ///< cases
  std::uint64_t drawn = 0;  ///< cases to which the contract applies
  /// Violated cases of both properties together, known defects and failed drawings included.
  std::uint64_t violated = 0;
  std::uint64_t samples = 0;        ///< for which the contract decides whether they are covered
  std::uint64_t wrong_samples = 0;  ///< missing, extra, or of another triangle than the nearest
  std::uint64_t values = 0;         ///< judged
  std::uint64_t not_judged = 0;     ///< values about which nothing is promised
  std::uint64_t wrong_values = 0;   ///< beyond the contract's bound, or not a number
  std::uint64_t not_numbers = 0;    ///< NaN, or infinite
  std::vector<AccuracyFigure> figures;
  std::string worst_case;  ///< that of the largest error of a smooth value; may be empty
  /// Of a benchmark's frame, relative to that of `cpu` (scripts/accuracy-table); empty if none was
  /// measured.
  std::optional<double> frame_time;
  bool operator==(const AccuracyRow&) const = default;

  /// True if all drawings are as the contract promises.
  bool keeps_promise() const { return violated == 0; }
  /// The figure of a kind in a stratum, or in all; nullptr if there are no such values.
  const AccuracyFigure* figure(AttributeKind kind, std::optional<Stratum> stratum) const;
};

struct AccuracyTable {
  std::string program;  ///< version of RasterCheck
  std::uint64_t seed = 0;
  std::vector<AccuracyRow> rows;
  bool operator==(const AccuracyTable&) const = default;
};

/// The row of a backend, from a run of both properties on the same cases: its summary and its
/// records. `drawn_by`, `date` and `frame_time` are left empty.
AccuracyRow accuracy_of(const std::vector<LawSummary>& rows, const RecordSet& records,
                        const std::string& backend);

/// Formats a table as a document, without a final newline.
std::string accuracy_json(const AccuracyTable& table);
Result<AccuracyTable> parse_accuracy(std::string_view text, const std::string& file);

}  // namespace rastercheck::records
