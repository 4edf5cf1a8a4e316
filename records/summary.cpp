#include "records/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace rastercheck::records {
namespace {

/// Keeps the larger of two extremes. If they are equal, the first stays, which is the negative one.
void keep_worst(SizeSummary& summary, const std::optional<WorstError>& extreme) {
  if (!extreme) return;
  const Enclosure magnitude = records::magnitude(extreme->error);
  const auto size = [](const Enclosure& of) { return std::pair(of.hi, of.lo); };
  if (summary.worst && size(magnitude) <= size(*summary.worst)) return;
  summary.worst = magnitude;
  summary.worst_at = extreme;
}

/// Compares extremes of different kinds by size alone, each in its own unit, because a table shows
/// the larger number.
void take_in(SizeSummary& summary, const ErrorSizes& sizes) {
  summary.histogram.merge(sizes.histogram);
  keep_worst(summary, sizes.extremes.most_negative);
  keep_worst(summary, sizes.extremes.most_positive);
}

void conclude(SizeSummary& summary) {
  summary.values = summary.histogram.count();
  // Errors of zero are on neither side of zero and leave no extreme.
  if (summary.values > 0 && !summary.worst) summary.worst = Enclosure{0, 0};
  summary.p99 = summary.histogram.quantile(kTail);
}

/// Empty if there is no value.
std::optional<Precision> precision_of(AttributeKind kind, std::optional<Stratum> stratum,
                                      const ErrorSizes& sizes) {
  const auto error_of = [](const std::optional<WorstError>& extreme) {
    return extreme ? extreme->error : Enclosure{0, 0};
  };
  const Histogram& histogram = sizes.histogram;
  Precision precision;
  precision.kind = kind;
  precision.stratum = stratum;
  precision.values = histogram.count() + histogram.non_finite();
  if (precision.values == 0) return std::nullopt;
  precision.min = error_of(sizes.extremes.most_negative);
  precision.max = error_of(sizes.extremes.most_positive);
  // Files from before sums existed have no sum, and merged files may have a sum of only a part of
  // the values.
  if (sizes.sum.count() == precision.values) precision.mean = sizes.sum.mean();
  precision.p50 = histogram.quantile(kMedian);
  precision.p99 = histogram.quantile(kTail);
  precision.p999 = histogram.quantile(kFarTail);
  precision.misrounded = histogram.count_above(kRoundingError);
  return precision;
}

void append_precision(std::vector<Precision>& rows, AttributeKind kind,
                      const ErrorStatistics& errors) {
  const auto append = [&](std::optional<Stratum> stratum, const ErrorSizes& sizes) {
    if (const auto row = precision_of(kind, stratum, sizes)) rows.push_back(*row);
  };
  append(std::nullopt, errors.ideal);
  for (const auto& [stratum, sizes] : errors.strata) append(stratum, sizes);
}

void append_stages(std::vector<StageMean>& rows, AttributeKind kind,
                   const ErrorStatistics& errors) {
  const auto append = [&](std::optional<Stratum> stratum, const std::map<Stage, SignedSum>& sums) {
    for (const auto& [stage, sum] : sums) {
      rows.push_back({kind, stratum, stage, sum.count() + sum.beyond(), sum.mean()});
    }
  };
  std::map<Stage, SignedSum> all;
  for (const auto& [stratum, sums] : errors.stages) {
    for (const auto& [stage, sum] : sums) all[stage].merge(sum);
  }
  append(std::nullopt, all);
  for (const auto& [stratum, sums] : errors.stages) append(stratum, sums);
}

/// A law counts as held only if it held for something: cases without anything drawn correctly do
/// not count.
LawVerdict verdict_of(const LawSummary& row, std::uint64_t correct_fragments) {
  if (row.cases.violations > 0) return LawVerdict::violated;
  if (row.cases.known > 0) return LawVerdict::known;
  if (correct_fragments == 0) return LawVerdict::not_checked;
  const bool is_thin = row.cases.checked < row.least_cases || !row.unreached.empty();
  return is_thin ? LawVerdict::thin : LawVerdict::held;
}

LawSummary summarize(const Run& run, const std::string& law, const std::string& backend) {
  LawSummary row;
  row.law = law;
  row.backend = backend;
  // Merges strata first, because within one kind merging decides between equally large errors by
  // their place.
  std::map<AttributeKind, Record> by_kind;
  for (const auto& [key, record] : run.records) {
    if (key.law == law && key.backend == backend) merge(by_kind[key.attribute_kind], record);
  }
  std::uint64_t correct_fragments = 0;
  bool has_values = false;
  for (const auto& [kind, record] : by_kind) {
    merge(row.cases, record.cases);
    merge(row.counts, record.counts);
    merge(row.classes, record.errors.classes);
    merge(row.levels, record.levels);
    merge(row.power, record.power);
    for (const auto& [label, cases] : record.labels) row.labels[label] += cases;
    for (const auto& [id, cases] : record.known) row.known[id] += cases;
    for (const auto& [why, cases] : record.not_applicable_because) {
      row.not_applicable_because[why] += cases;
    }
    add(row.judged, kind, record.errors);
    if (kind == AttributeKind::coverage) {
      correct_fragments = record.errors.classes[FragmentClass::correct];
      for (const auto& [why, count] : record.errors.not_judged) correct_fragments -= count;
    } else {
      has_values = true;
      take_in(row.ideal, record.errors.ideal);
      take_in(row.excess, record.errors.excess);
      append_precision(row.precision, kind, record.errors);
      append_stages(row.stages, kind, record.errors);
    }
  }
  conclude(row.ideal);
  conclude(row.excess);
  std::copy_if(
      run.unreached.begin(), run.unreached.end(), std::back_inserter(row.unreached),
      [&](const UnreachedLabel& label) { return label.law == law && label.backend == backend; });
  for (const SkippedLaw& skipped : skipped_laws(run)) {
    if (skipped.backend == backend && skipped.law == law) row.skipped_by = skipped.file;
  }
  row.judged.asked = row.cases.checked + row.cases.not_applicable;
  row.judged.applicable = row.cases.checked;
  row.least_cases = run.plan.require_cases.value_or(usual_least_cases(row.judged.asked));
  // Correct coverage alone does not make a law about values hold.
  const bool is_any_judged = !has_values || row.judged.values > 0 || row.judged.not_judged.empty();
  row.verdict = verdict_of(row, is_any_judged ? correct_fragments : 0);
  return row;
}

}  // namespace

std::string_view to_string(LawVerdict verdict) {
  constexpr std::array<std::string_view, 5> kWords{"held", "violated", "known", "thin",
                                                   "not checked"};
  return kWords[static_cast<std::size_t>(verdict)];
}

std::vector<LawSummary> summarize(const Run& run) {
  std::vector<LawSummary> rows;
  for (const std::string& law : run.plan.laws) {
    for (const std::string& backend : run.plan.backends)
      rows.push_back(summarize(run, law, backend));
  }
  return rows;
}

std::map<std::string, Power> power_by_backend(const std::vector<LawSummary>& rows) {
  std::map<std::string, Power> all;
  for (const LawSummary& row : rows) {
    if (!row.power.empty()) merge(all[row.backend], row.power);
  }
  return all;
}

LawVerdict verdict_of(const std::vector<LawSummary>& rows) {
  const auto any = [&rows](LawVerdict verdict) {
    return std::any_of(rows.begin(), rows.end(),
                       [verdict](const LawSummary& row) { return row.verdict == verdict; });
  };
  if (any(LawVerdict::violated)) return LawVerdict::violated;
  if (any(LawVerdict::held)) return LawVerdict::held;
  if (any(LawVerdict::known)) return LawVerdict::known;
  return any(LawVerdict::thin) ? LawVerdict::thin : LawVerdict::not_checked;
}

std::vector<KnownSummary> known_defects(const Run& run) {
  std::map<std::pair<std::string, std::string>, std::uint64_t> cases;
  for (const auto& [key, record] : run.records) {
    for (const auto& [id, count] : record.known) cases[{key.backend, id}] += count;
  }
  std::vector<KnownSummary> all;
  for (const KnownOfBackend& known : run.known) {
    for (const KnownEntry& entry : known.list.entries) {
      if (entry.expected == Expected::skip) continue;
      const bool is_passed = std::any_of(
          run.unexpected.begin(), run.unexpected.end(), [&](const UnexpectedPass& pass) {
            return pass.backend == known.backend && pass.id == entry.id;
          });
      all.push_back({known.backend, entry, cases[{known.backend, entry.id}], is_passed});
    }
  }
  return all;
}

std::uint64_t usual_least_cases(std::uint64_t asked) {
  constexpr std::uint64_t kLeast = 20;
  return std::min(asked, std::max(kLeast, asked / 50));
}

std::string thin_words(const LawSummary& row) {
  std::string text = fmt::format("{} of {} cases", row.cases.checked, row.judged.asked);
  for (const UnreachedLabel& label : row.unreached) {
    text += fmt::format(", '{}' in {} of at least {}", label.label, label.reached, label.least);
  }
  return text;
}

std::string thin_sentence(const std::vector<LawSummary>& rows) {
  std::size_t count = 0;
  std::uint64_t least = 0;
  std::size_t unreached = 0;
  for (const LawSummary& row : rows) {
    if (row.verdict != LawVerdict::thin) continue;
    if (row.cases.checked < row.least_cases) {
      ++count;
      least = std::max(least, row.least_cases);
    } else {
      ++unreached;
    }
  }
  const auto properties = [](std::size_t number) {
    return fmt::format("{} {}", number, number == 1 ? "property" : "properties");
  };
  std::string text;
  if (count > 0) text = fmt::format("{} held on fewer than {} cases", properties(count), least);
  if (unreached == 0) return text;
  return text + fmt::format("{}{} held without reaching a required label", text.empty() ? "" : "; ",
                            properties(unreached));
}

std::vector<std::pair<std::uint64_t, std::string>> reasons_of(const LawSummary& row) {
  std::vector<std::pair<std::uint64_t, std::string>> all;
  all.reserve(row.not_applicable_because.size());
  for (const auto& [why, cases] : row.not_applicable_because) all.emplace_back(cases, why);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  return all;
}

std::string why_not_checked(const LawSummary& row) {
  if (row.cases.checked > 0) return "";
  if (!row.skipped_by.empty()) return "skipped by " + row.skipped_by;
  const auto all = reasons_of(row);
  return all.empty() ? "" : all.front().second;
}

}  // namespace rastercheck::records
