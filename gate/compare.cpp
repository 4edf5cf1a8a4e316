#include "gate/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "cases/contract_json.h"
#include "gate/internal/compare_cases.h"
#include "records/summary.h"

namespace rastercheck::gate {
namespace {

using records::Enclosure;

// --- What cannot be compared ---------------------------------------------------------------------

std::string words_of(const records::Plan& plan) {
  const std::vector<std::string> words = records::option_words(plan);
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, " "));
}

/// Returns the options that decide how cases are judged, except a contract. Leaves out corpus,
/// worst cases of hunts and capabilities: digests identify the cases.
records::Plan judged_by(records::Plan plan) {
  plan.seed = 0;
  plan.capabilities.clear();
  plan.cases_per_law = 0;
  plan.contract.reset();
  plan.corpus.clear();
  plan.hunted.clear();
  return plan;
}

/// Describes how the terms of the two plans differ; empty if they do not. Ignores the contract
/// file's path.
std::string other_options(const records::Plan& before, const records::Plan& after) {
  const records::Plan was = judged_by(before);
  const records::Plan is = judged_by(after);
  if (was != is) {
    return fmt::format("the options are {} in the baseline and {} now", words_of(was),
                       words_of(is));
  }
  const auto digest = [](const records::Plan& plan) {
    return plan.contract ? fmt::format("{:016x}", cases::digest_of(plan.contract->terms)) : "none";
  };
  const auto file = [](const records::Plan& plan) {
    return plan.contract ? plan.contract->file : "none";
  };
  if (digest(before) == digest(after)) return "";
  return fmt::format(
      "the contract is {} in the baseline and {} now, and its terms differ: their digest was {} "
      "and is {}",
      file(before), file(after), digest(before), digest(after));
}

/// Describes how the cases of a common law differ; empty if they are the same cases.
std::string other_cases(const std::string& law, const records::LawCases& before,
                        const records::LawCases& after) {
  if (before.count != after.count) {
    return fmt::format("the property '{}' has {} cases in the baseline and {} now", law,
                       before.count, after.count);
  }
  if (before.digest == after.digest) return "";
  return fmt::format(
      "the cases of the property '{}' differ from the baseline's: their digest was {:016x} and is "
      "{:016x}",
      law, before.digest, after.digest);
}

/// Returns text such as "the seed is 1 in the baseline and 2 now".
std::string numbers(std::string_view what, std::uint64_t was, std::uint64_t is) {
  return fmt::format("{} {} in the baseline and {} now", what, was, is);
}

std::string other_versions(const records::BaselineSection& before,
                           const records::BaselineSection& after) {
  if (before.records_version != after.records_version) {
    return numbers("the version of records is", before.records_version, after.records_version);
  }
  if (before.rules_version != after.rules_version) {
    return numbers("the version of the rules is", before.rules_version, after.rules_version);
  }
  return "";
}

/// Returns why the two sections' figures are not comparable; empty if they are.
std::string difference(const records::BaselineSection& before,
                       const records::BaselineSection& after) {
  if (std::string other = other_versions(before, after); !other.empty()) return other;
  const records::Plan& was = before.plan;
  const records::Plan& is = after.plan;
  if (was.seed != is.seed) return numbers("the seed is", was.seed, is.seed);
  if (was.cases_per_law != is.cases_per_law) {
    return numbers("the number of cases per property is", was.cases_per_law, is.cases_per_law);
  }
  if (was.hunted != is.hunted) {
    return fmt::format(
        "the baseline has {} worst cases of hunts and this side {}, not all the same; `rastercheck "
        "run --baseline` checks those of the baseline",
        was.hunted.size(), is.hunted.size());
  }
  if (std::string other = other_options(was, is); !other.empty()) return other;
  for (const auto& [law, cases] : before.laws) {
    const auto now = after.laws.find(law);
    if (now == after.laws.end()) continue;
    if (std::string other = other_cases(law, cases, now->second); !other.empty()) return other;
  }
  return "";
}

// --- Figures -------------------------------------------------------------------------------------

/// Collects an entry's changed figures.
class FigureComparer {
 public:
  explicit FigureComparer(std::vector<records::FigureChange>& changes) : changes_(changes) {}

  void count(records::Figure figure, std::uint64_t before, std::uint64_t after,
             records::FragmentClass of = records::FragmentClass::correct) {
    if (before == after) return;
    const bool is_more_worse =
        figure != records::Figure::checked && figure != records::Figure::noticed;
    add(figure, (after > before) == is_more_worse, {std::nullopt, before, 0},
        {std::nullopt, after, 0}, of);
  }
  /// Compares shares exactly, in whole numbers. Ignores shares of an empty whole.
  void share(records::Figure figure, std::uint64_t before, std::uint64_t of_before,
             std::uint64_t after, std::uint64_t of_after) {
    __extension__ using Wide = unsigned __int128;
    if (of_before == 0 || of_after == 0) return;
    const Wide was = static_cast<Wide>(before) * of_after;
    const Wide is = static_cast<Wide>(after) * of_before;
    if (was == is) return;
    add(figure, is > was, {std::nullopt, before, of_before}, {std::nullopt, after, of_after});
  }
  void size(records::Figure figure, const std::optional<Enclosure>& before,
            const std::optional<Enclosure>& after) {
    if (!before || !after || *before == *after) return;
    add(figure, is_larger(*after, *before), {before, 0, 0}, {after, 0, 0});
  }

 private:
  void add(records::Figure figure, bool is_worse, const records::FigureValue& before,
           const records::FigureValue& after,
           records::FragmentClass of = records::FragmentClass::correct) {
    changes_.push_back(
        {figure, of, is_worse ? records::Change::worse : records::Change::better, before, after});
  }

  std::vector<records::FigureChange>& changes_;
};

/// Returns the number of fragments or values that were drawn or are missing, judged or not. For
/// coverage, the classes include fragments that are not judged.
std::uint64_t drawn_of(records::AttributeKind kind, const records::EntryFigures& figures) {
  const auto& classes = figures.classes.counts;
  const std::uint64_t all = std::accumulate(classes.begin(), classes.end(), std::uint64_t{0});
  return kind == records::AttributeKind::coverage ? all : all + figures.not_judged.value_or(0);
}

std::vector<records::FigureChange> figure_changes(records::AttributeKind kind,
                                                  const records::EntryFigures& before,
                                                  const records::EntryFigures& after) {
  std::vector<records::FigureChange> changes;
  FigureComparer compare(changes);
  compare.count(records::Figure::violations, before.cases.violations, after.cases.violations);
  compare.count(records::Figure::known, before.cases.known, after.cases.known);
  compare.count(records::Figure::checked, before.cases.checked, after.cases.checked);
  // The number of drawings that are made wrong on purpose depends on how many cases held, so that
  // number may change although the backend is no worse.
  if (before.power.drawings == after.power.drawings) {
    compare.count(records::Figure::noticed, before.power.noticed, after.power.noticed);
  }
  for (std::size_t i = 0; i < before.classes.counts.size(); ++i) {
    const auto fragment_class = static_cast<records::FragmentClass>(i);
    if (fragment_class == records::FragmentClass::correct) continue;
    compare.count(records::Figure::mismatches, before.classes[fragment_class],
                  after.classes[fragment_class], fragment_class);
  }
  // If the counts are equal, a share changes only because more or fewer were drawn.
  if (before.not_judged && after.not_judged && *before.not_judged != *after.not_judged) {
    compare.share(records::Figure::not_judged, *before.not_judged, drawn_of(kind, before),
                  *after.not_judged, drawn_of(kind, after));
  }
  const records::Histogram& was = before.histogram;
  const records::Histogram& is = after.histogram;
  const std::uint64_t values_before = was.count() + was.non_finite();
  const std::uint64_t values_after = is.count() + is.non_finite();
  if (values_before == 0 || values_after == 0) return changes;
  compare.size(records::Figure::worst, before.worst, after.worst);
  compare.share(records::Figure::misrounded, was.count_above(records::kRoundingError),
                values_before, is.count_above(records::kRoundingError), values_after);
  compare.size(records::Figure::p999, was.quantile(records::kFarTail),
               is.quantile(records::kFarTail));
  compare.size(records::Figure::p99, was.quantile(records::kTail), is.quantile(records::kTail));
  compare.size(records::Figure::p50, was.quantile(records::kMedian), is.quantile(records::kMedian));
  return changes;
}

records::Change change_of(const std::vector<records::FigureChange>& figures) {
  const auto some = [&figures](records::Change change) {
    return std::any_of(figures.begin(), figures.end(),
                       [change](const records::FigureChange& one) { return one.change == change; });
  };
  if (some(records::Change::worse)) return records::Change::worse;
  return some(records::Change::better) ? records::Change::better : records::Change::same;
}

// --- Stages --------------------------------------------------------------------------------------

using Means = std::map<records::Stage, std::optional<Enclosure>>;

Means means_of(const records::EntryFigures& figures) {
  Means means;
  for (const auto& [stage, sum] : figures.stages) means[stage] = sum.mean();
  return means;
}

/// Returns a stage's share for display: the exact share may differ in the last few places.
std::optional<double> share_of(const Means& means, records::Stage stage) {
  double all = 0;
  for (const auto& [each, mean] : means) all += mean ? mean->hi : 0;
  const auto found = means.find(stage);
  if (found == means.end() || !found->second || !(all > 0)) return std::nullopt;
  return found->second->hi / all;
}

/// True if the stage is real work that a developer can look at, not a stand-in for backends that
/// report no stages.
bool is_work(records::Stage stage) {
  return stage != records::Stage::left_open && stage != records::Stage::excess;
}

/// True if the backend reported any stage. Other backends only have `left_open` and `excess`, and
/// `transform`, which describes the input.
bool has_work(const Means& means) {
  return std::any_of(means.begin(), means.end(), [](const auto& of) {
    return of.first != records::Stage::transform && is_work(of.first);
  });
}

void compare_stages(records::EntryChange& entry) {
  const Means before = means_of(entry.before);
  const Means after = means_of(entry.after);
  if (before.empty() || after.empty()) return;
  const auto mean_in = [](const Means& means, records::Stage stage) {
    const auto found = means.find(stage);
    return found == means.end() ? std::optional<Enclosure>() : found->second;
  };
  const bool is_told = has_work(before) || has_work(after);
  double most = 1;
  for (std::size_t i = 0; i < names_of(records::Stage{}).size(); ++i) {
    const auto stage = static_cast<records::Stage>(i);
    if (!before.contains(stage) && !after.contains(stage)) continue;
    records::StageChange change{stage, mean_in(before, stage), mean_in(after, stage),
                                share_of(before, stage), share_of(after, stage)};
    const double growth = growth_of(change);
    if (is_told && is_work(stage) && growth > most) {
      most = growth;
      entry.grown_stage = stage;
    }
    entry.stages.push_back(change);
  }
}

// --- Entries -------------------------------------------------------------------------------------

std::vector<records::EntryChange> entry_changes(const records::BaselineSection& before,
                                                const records::BaselineSection& after) {
  std::map<records::EntryKey, records::EntryChange> entries;
  const std::map<records::EntryKey, std::uint64_t> grown = grown_cases(before, after);
  for (const auto& [key, figures] : before.entries) {
    records::EntryChange& entry = entries[key];
    entry.key = key;
    entry.change = records::Change::gone;
    entry.before = figures;
  }
  for (const auto& [key, figures] : after.entries) {
    records::EntryChange& entry = entries[key];
    entry.after = figures;
    if (!before.entries.contains(key)) {
      entry.key = key;
      entry.change = records::Change::appeared;
      continue;
    }
    entry.figures = figure_changes(key.kind, entry.before, entry.after);
    if (const auto cases = grown.find(key); cases != grown.end()) {
      FigureComparer(entry.figures).count(records::Figure::grown_cases, 0, cases->second);
    }
    entry.change = change_of(entry.figures);
    compare_stages(entry);
  }
  std::vector<records::EntryChange> all;
  all.reserve(entries.size());
  for (auto& [key, entry] : entries) all.push_back(std::move(entry));
  return all;
}

std::vector<std::string> laws_without(const records::BaselineSection& of,
                                      const records::BaselineSection& without) {
  std::vector<std::string> laws;
  for (const auto& [law, cases] : of.laws) {
    if (!without.laws.contains(law)) laws.push_back(law);
  }
  return laws;
}

}  // namespace

Result<records::Comparison> compare(const records::BaselineSection& before,
                                    const records::BaselineSection& after,
                                    const CompareOptions& options) {
  if (const std::string other = difference(before, after); !other.empty()) {
    return tl::unexpected(Error{"", to_string(before.key), other});
  }
  records::Comparison comparison;
  comparison.key = before.key;
  comparison.backend = after.taken.backend;
  comparison.before = before.taken;
  comparison.after = after.taken;
  comparison.plan = after.plan;
  comparison.entries = entry_changes(before, after);
  comparison.gone_laws = laws_without(before, after);
  comparison.new_laws = laws_without(after, before);
  compare_cases(before, after, options, comparison);
  return comparison;
}

Result<const records::BaselineSection*> section_for(const records::Baseline& baseline,
                                                    const records::BaselineSection& current,
                                                    const std::string& file) {
  if (const records::BaselineSection* found = find_section(baseline, current)) return found;
  std::vector<std::string> there;
  there.reserve(baseline.sections.size());
  for (const records::BaselineSection& each : baseline.sections)
    there.push_back(to_string(each.key));
  const records::BaselineKey asked{current.key.backend, current.key.architecture,
                                   current.taken.instruction_set, current.taken.compiler};
  return tl::unexpected(
      Error{file, "",
            fmt::format(
                "has no section for {}; it has {}", to_string(asked),
                there.empty() ? "none" : fmt::format("sections for {}", fmt::join(there, "; ")))});
}

Result<void> check_versions(const records::BaselineSection& before,
                            const records::BaselineSection& after) {
  const std::string other = other_versions(before, after);
  if (other.empty()) return {};
  return tl::unexpected(Error{"", to_string(before.key), other});
}

Result<std::vector<records::Comparison>> compare(const records::Baseline& baseline,
                                                 const records::Baseline& current,
                                                 const CompareFiles& files,
                                                 const CompareOptions& options) {
  std::vector<records::Comparison> comparisons;
  for (const records::BaselineSection& now : current.sections) {
    const Result<const records::BaselineSection*> then = section_for(baseline, now, files.baseline);
    if (!then) return tl::unexpected(then.error());
    Result<records::Comparison> comparison = compare(**then, now, options);
    if (!comparison) {
      return tl::unexpected(
          Error{files.baseline, comparison.error().place, comparison.error().reason});
    }
    comparisons.push_back(*std::move(comparison));
  }
  // An empty comparison must not pass for one without worse figures.
  if (comparisons.empty()) {
    return tl::unexpected(
        Error{files.current, "", "has no sections, so there is nothing to compare"});
  }
  return comparisons;
}

}  // namespace rastercheck::gate
