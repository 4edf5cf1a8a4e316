#include "reports/internal/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "cases/json.h"
#include "records/share.h"

namespace rastercheck::reports {
namespace {

using records::LawSummary;
using records::LawVerdict;

double to_double(std::string_view text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// A positive finite number with `digits` significant digits, rounded up.
std::string rounded_up(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const double nearest = to_double(text);
  if (nearest >= value) return fmt::format("{:.{}g}", nearest, digits);
  // The next decimal with that many digits is one unit in the last digit higher.
  int exponent = 0;
  const std::size_t mark = text.find('e') + 1;
  const char* const sign_skipped = text.data() + mark + (text[mark] == '+' ? 1 : 0);
  std::from_chars(sign_skipped, text.data() + text.size(), exponent);
  const double unit = to_double(fmt::format("1e{}", exponent - digits + 1));
  return fmt::format("{:.{}g}", nearest + unit, digits);
}

/// The verdict as it follows "3 properties".
std::string_view verdict_words(LawVerdict verdict) {
  switch (verdict) {
    case LawVerdict::violated:
      return "violated";
    case LawVerdict::known:
      return "violated in known ways only";
    case LawVerdict::thin:
      return "held on few cases";
    case LawVerdict::held:
      return "held";
    case LawVerdict::not_checked:
      break;
  }
  return "not checked";
}

std::uint64_t count_of(const std::vector<LawSummary>& rows, LawVerdict verdict) {
  return static_cast<std::uint64_t>(
      std::count_if(rows.begin(), rows.end(),
                    [verdict](const LawSummary& row) { return row.verdict == verdict; }));
}

/// The number of known defects that a run saw.
std::uint64_t known_defect_count(const records::Run& run) {
  const std::vector<records::KnownSummary> all = records::known_defects(run);
  return static_cast<std::uint64_t>(std::count_if(
      all.begin(), all.end(), [](const records::KnownSummary& known) { return known.cases > 0; }));
}

}  // namespace

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string counted(std::uint64_t number, std::string_view singular, std::string_view plural) {
  return fmt::format("{} {}", grouped(number), number == 1 ? singular : plural);
}

std::string number_text(const std::optional<records::Enclosure>& number) {
  constexpr int kDigits = 6;
  return number ? records::to_decimal(*number, kDigits) : std::string(kNothing);
}

std::string at_most_text(const std::optional<records::Enclosure>& number) {
  constexpr int kDigits = 3;
  if (!number) return std::string(kNothing);
  if (number->hi == 0) return "0";
  if (std::isinf(number->hi)) return "> " + fmt::format("{:.{}g}", number->lo, kDigits);
  return "≤ " + rounded_up(number->hi, kDigits);
}

std::string mean_text(const std::optional<records::Enclosure>& mean) {
  constexpr int kDigits = 4;
  constexpr int kDigitsOfBound = 2;
  if (!mean) return std::string(kNothing);
  const std::optional<std::string> certain = records::certain_decimal(*mean, kDigits);
  return certain ? *certain : "± " + rounded_up(records::magnitude_bound(*mean), kDigitsOfBound);
}

std::array<std::string, kPrecisionColumns.size()> precision_cells(
    const records::Precision& precision) {
  return {
      grouped(precision.values),    number_text(precision.min),
      mean_text(precision.mean),    number_text(precision.max),
      at_most_text(precision.p50),  at_most_text(precision.p99),
      at_most_text(precision.p999), records::share_text(precision.misrounded, precision.values)};
}

std::string_view stratum_text(const records::Precision& precision) {
  return precision.stratum ? to_string(*precision.stratum) : "all";
}

std::string elided(std::string_view text, std::size_t most) {
  const auto continues = [text](std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U;
  };
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) characters += continues(i) ? 0U : 1U;
  if (characters <= most) return std::string(text);

  const std::size_t of_end = (most - 1) / 2;
  const std::size_t of_start = most - 1 - of_end;
  std::size_t start = 0;  // where the omitted part begins
  for (std::size_t i = 0; i < of_start; ++i) {
    do {
      ++start;
    } while (continues(start));
  }
  std::size_t end = text.size();  // where it ends
  for (std::size_t i = 0; i < of_end; ++i) {
    do {
      --end;
    } while (continues(end));
  }
  return std::string(text.substr(0, start)) + "…" + std::string(text.substr(end));
}

int urgency(LawVerdict verdict) {
  switch (verdict) {
    case LawVerdict::violated:
      return 0;
    case LawVerdict::known:
      return 1;
    case LawVerdict::thin:
      return 2;
    case LawVerdict::held:
      return 3;
    case LawVerdict::not_checked:
      break;
  }
  return 4;
}

std::vector<VerdictCount> verdict_counts(const records::Run& run,
                                         const std::vector<LawSummary>& rows,
                                         std::string_view backend) {
  constexpr std::array kWorstFirst{LawVerdict::violated, LawVerdict::known, LawVerdict::thin,
                                   LawVerdict::held, LawVerdict::not_checked};
  std::vector<VerdictCount> counts;
  for (const LawVerdict verdict : kWorstFirst) {
    const auto count = static_cast<std::uint64_t>(std::count_if(
        rows.begin(), rows.end(),
        [&](const LawSummary& row) { return row.backend == backend && row.verdict == verdict; }));
    if (count == 0) continue;
    std::string text =
        counts.empty() ? counted(count, "property", "properties") : std::to_string(count);
    text += fmt::format(" {}", verdict_words(verdict));
    if (verdict == LawVerdict::violated) {
      const auto causes = static_cast<std::uint64_t>(
          std::count_if(run.causes.begin(), run.causes.end(),
                        [&](const records::Cause& cause) { return cause.backend == backend; }));
      if (causes > 0) text += fmt::format(" ({})", counted(causes, "cause", "causes"));
    }
    counts.push_back({verdict, std::move(text)});
  }
  return counts;
}

Mood mood_of(const std::vector<LawSummary>& rows) {
  const LawVerdict verdict = records::verdict_of(rows);
  if (verdict == LawVerdict::violated) return Mood::bad;
  if (verdict != LawVerdict::held || count_of(rows, LawVerdict::known) > 0) return Mood::mixed;
  return 2 * count_of(rows, LawVerdict::held) > rows.size() ? Mood::good : Mood::mixed;
}

std::string headline(const records::Run& run, const std::vector<LawSummary>& rows) {
  // With several backends a property counts once, with its worst verdict.
  std::map<std::string_view, LawVerdict> worst;
  for (const LawSummary& row : rows) {
    LawVerdict& verdict = worst.try_emplace(row.law, row.verdict).first->second;
    if (urgency(row.verdict) < urgency(verdict)) verdict = row.verdict;
  }
  const auto count = [&worst](LawVerdict verdict) {
    return static_cast<std::uint64_t>(
        std::count_if(worst.begin(), worst.end(),
                      [verdict](const auto& entry) { return entry.second == verdict; }));
  };
  const std::string all = counted(worst.size(), "property", "properties");
  if (const std::uint64_t violated = count(LawVerdict::violated); violated > 0) {
    std::string text = fmt::format("{} of {} violated", violated, all);
    if (!run.causes.empty()) text += ", " + counted(run.causes.size(), "cause", "causes");
    return text;
  }
  if (const std::uint64_t known = count(LawVerdict::known); known > 0) {
    return fmt::format("Nothing new: {} violated in {}", counted(known, "property", "properties"),
                       counted(known_defect_count(run), "known way", "known ways"));
  }
  const std::uint64_t held = count(LawVerdict::held);
  if (held > 1 && held == worst.size()) return fmt::format("All {} held", all);
  if (held > 0) return fmt::format("{} of {} held", held, all);
  const std::uint64_t thin = count(LawVerdict::thin);
  return thin > 0 ? fmt::format("{} of {} held, on few cases", thin, all) : "Nothing was checked";
}

std::string not_judged_share(const records::Judged& judged) {
  const double percent = 100 * judged.share_not_judged();
  if (percent == 0) return "–";
  if (percent < 1) return "< 1%";
  // Rounded down: "100%" would mean that nothing was judged.
  return fmt::format("{}%", static_cast<int>(percent));
}

LawSummary totals(const std::vector<LawSummary>& rows) {
  LawSummary total;
  for (const LawSummary& row : rows) {
    records::merge(total.cases, row.cases);
    records::merge(total.counts, row.counts);
    records::merge(total.classes, row.classes);
    records::merge(total.levels, row.levels);
    records::merge(total.judged, row.judged);
    total.ideal.values += row.ideal.values;
    total.excess.values += row.excess.values;
  }
  total.verdict = records::verdict_of(rows);
  return total;
}

bool has_precision(const std::vector<LawSummary>& rows) {
  return std::any_of(rows.begin(), rows.end(),
                     [](const LawSummary& row) { return !row.precision.empty(); });
}

std::string verdict_text(const LawSummary& row) {
  switch (row.verdict) {
    case LawVerdict::violated:
      return fmt::format("violated in {}", counted(row.cases.violations, "case", "cases"));
    case LawVerdict::known:
      return fmt::format("known in {}", counted(row.cases.known, "case", "cases"));
    case LawVerdict::thin:
      return fmt::format("thin: {}", records::thin_words(row));
    case LawVerdict::held:
    case LawVerdict::not_checked:
      break;
  }
  return std::string(to_string(row.verdict));
}

}  // namespace rastercheck::reports
