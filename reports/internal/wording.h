#pragma once

// Shared wording of the reports for people: numbers, commands and the verdict.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/run.h"
#include "records/summary.h"

namespace rastercheck::reports {

/// Sentences that explain the numbers of a table.
inline constexpr std::string_view kUnitSentence =
    "Errors are in scale ULP: 1 is the spacing of float32 numbers at the largest of the "
    "triangle's three values of the attribute (or at the exact value, where that is larger), so "
    "that a correctly rounded value is off by at most 0.5; depth counts the spacing at the "
    "greater end of the depth range.";
inline constexpr std::string_view kExcessSentence =
    "Worst and p99 are errors against the exact triangle; 99 of 100 are at most p99. The worst "
    "error "
    "after allowances is what remains after everything that the backend's contract leaves open, "
    "such "
    "as snapping, and is what its limits apply to.";

inline constexpr std::string_view kPrecisionSentence =
    "Precision is against the exact triangle. Min and max are the largest errors below and above "
    "it, 0 where there is none; the mean is of signed errors; half of all magnitudes are at most "
    "p50, 99 of 100 at most p99, 999 of 1,000 at most p99.9; misrounded is the share off by more "
    "than 0.5, as no correctly rounded value is. A value is of the first stratum that holds: "
    "clipped, near horizon (the greatest w is over 16 times the least), sliver (less high than "
    "1/64 of the longest edge), multisampled, ordinary.";

/// Stands for a number that does not exist.
inline constexpr std::string_view kNothing = "–";

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

/// "1 case", "2 cases".
std::string counted(std::uint64_t number, std::string_view singular, std::string_view plural);

/// The certain digits of an enclosed number; a dash if there is none.
std::string number_text(const std::optional<records::Enclosure>& number);

/// The upper end with three significant digits, rounded up: "≤ 0.459"; "0" for zero; a dash if
/// there is no number.
std::string at_most_text(const std::optional<records::Enclosure>& number);

/// The certain digits of a mean, at most a few. If no digit is certain, as may happen near 0, a
/// bound on its magnitude: "± 4.7e-10".
std::string mean_text(const std::optional<records::Enclosure>& mean);

/// The columns of a table of precision, after those that identify the values.
inline constexpr std::array<std::string_view, 8> kPrecisionColumns{
    "values", "min", "mean", "max", "p50", "p99", "p99.9", "misrounded"};
std::array<std::string, kPrecisionColumns.size()> precision_cells(
    const records::Precision& precision);

/// The stratum's word, or "all".
std::string_view stratum_text(const records::Precision& precision);

/// Shortens a text to at most `most` characters (at least 16) by replacing its middle with "…".
/// Exact fractions may have hundreds of digits; run.json has all of them. UTF-8 characters stay
/// whole.
std::string elided(std::string_view text, std::size_t most);

/// The rank of a verdict in tables, the most urgent first: 0 for a violated property.
int urgency(records::LawVerdict verdict);

/// How many properties of a backend have one verdict: "2 properties violated (3 causes)". The
/// first of several parts names what is counted, the others do not: "40 held".
struct VerdictCount {
  records::LawVerdict verdict = records::LawVerdict::held;
  std::string text;
};
/// The verdicts of one backend, the worst first.
std::vector<VerdictCount> verdict_counts(const records::Run& run,
                                         const std::vector<records::LawSummary>& rows,
                                         std::string_view backend);

/// Sums up a run in one line, without a full stop: "2 of 46 properties violated, 3 causes".
std::string headline(const records::Run& run, const std::vector<records::LawSummary>& rows);

/// The impression that a headline should make.
enum class Mood {
  good,   ///< more than half of all rows held, and none was violated, not even in known ways
  mixed,  ///< nothing new is wrong, but little was judged or defects are known
  bad,    ///< something is wrong
};
Mood mood_of(const std::vector<records::LawSummary>& rows);

/// "violated in 3 cases", "known in 2 cases", "held", "not checked".
std::string verdict_text(const records::LawSummary& row);

/// "12%" or "< 1%" of fragments and values; a dash if all were judged.
std::string not_judged_share(const records::Judged& judged);

/// The sum of all rows, without sizes and labels.
records::LawSummary totals(const std::vector<records::LawSummary>& rows);

/// True if any row has a table of precision.
bool has_precision(const std::vector<records::LawSummary>& rows);

}  // namespace rastercheck::reports
