#include "gate/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <span>
#include <string_view>
#include <tuple>

#include "cases/digest.h"

namespace rastercheck::gate {
namespace {

using records::AttributeKind;

std::string in_environment(const records::Run& run, const std::string& name) {
  const auto found = run.environment.find(name);
  return found == run.environment.end() ? std::string() : found->second;
}

records::Enclosure largest_in(const records::Extremes& extremes) {
  const records::WorstError* worst = records::worst_of(extremes);
  return worst == nullptr ? records::Enclosure() : records::magnitude(worst->error);
}

records::EntryFigures figures_of(const records::ErrorSizes& sizes) {
  records::EntryFigures figures;
  figures.histogram = sizes.histogram;
  figures.worst = largest_in(sizes.extremes);
  return figures;
}

bool is_empty(records::EntryFigures figures) {
  if (figures.not_judged == 0U) figures.not_judged.reset();
  return figures == records::EntryFigures();
}

/// Adds the entries of one law and kind.
void add_entries(std::map<records::EntryKey, records::EntryFigures>& entries,
                 const std::string& law, AttributeKind kind, const records::Record& record) {
  records::EntryFigures all = figures_of(record.errors.ideal);
  all.classes = record.errors.classes;
  all.not_judged = 0;
  for (const auto& [why, count] : record.errors.not_judged) *all.not_judged += count;
  if (kind == AttributeKind::coverage) {
    all.cases = record.cases;
    all.power = records::total(record.power);
  }
  std::map<records::Stratum, records::EntryFigures> strata;
  for (const auto& [stratum, sizes] : record.errors.strata) strata[stratum] = figures_of(sizes);
  for (const auto& [stratum, stages] : record.errors.stages) {
    strata[stratum].stages = stages;
    for (const auto& [stage, sum] : stages) all.stages[stage].merge(sum);
  }
  // Coverage always gets an entry, so that a law which no longer checks any case is visible.
  if (kind == AttributeKind::coverage || !is_empty(all)) {
    entries[{law, kind, std::nullopt}] = std::move(all);
  }
  for (auto& [stratum, figures] : strata) {
    if (!is_empty(figures)) entries[{law, kind, stratum}] = std::move(figures);
  }
}

std::map<records::EntryKey, records::EntryFigures> entries_of(const records::Run& run,
                                                              const std::string& backend) {
  // Merges the strata of the generators, as tables do (records/summary.cpp).
  std::map<std::pair<std::string, AttributeKind>, records::Record> by_kind;
  for (const std::string& law : run.plan.laws) by_kind[{law, AttributeKind::coverage}];
  for (const auto& [key, record] : run.records) {
    if (key.backend != backend || !records::is_frozen(key)) continue;
    records::merge(by_kind[{key.law, key.attribute_kind}], record);
  }
  std::map<records::EntryKey, records::EntryFigures> entries;
  for (const auto& [key, record] : by_kind) add_entries(entries, key.first, key.second, record);
  return entries;
}

void add_cases(records::BaselineSection& section, const records::CaseRecordSet& all,
               const std::string& backend) {
  for (const auto& [key, record] : all) {
    if (key.backend != backend) continue;
    records::LawCases& law = section.laws[key.law];
    // Whether a case was generated again (records::kRedrawn) depends on the judged backend, so only
    // the original cases are counted and digested.
    if (key.index < records::kRedrawn) {
      ++law.count;
      law.digest += cases::fnv1a(
          fmt::format("{} {} {:016x}", to_string(key.origin), key.index, record.source_digest));
    }
    if (key.origin == records::Origin::corpus) section.corpus[key.index] = record.name;
    if (record.outcome == records::CaseOutcome::not_applicable) continue;
    law.cases[{key.origin, key.index}] = {record.found_digest, record.mismatches, record.worst,
                                          record.outcome};
  }
}

Error refusal(const std::string& reason) { return {"", "", reason}; }

}  // namespace

Result<records::BaselineSection> section_of(const records::Run& run, const std::string& backend) {
  if (std::find(run.plan.backends.begin(), run.plan.backends.end(), backend) ==
      run.plan.backends.end()) {
    return tl::unexpected(
        refusal(fmt::format("the run does not include the backend '{}'", backend)));
  }
  if (!run.cases) {
    return tl::unexpected(
        refusal("the run did not keep its cases; run it again with --keep-cases"));
  }
  if (run.cases_left > 0) {
    return tl::unexpected(
        refusal("the run was interrupted; finish it with `rastercheck run --resume`"));
  }
  if (run.shard) {
    return tl::unexpected(refusal(fmt::format(
        "the run is only shard {}; `rastercheck merge` combines all {} into the whole run",
        records::to_string(*run.plan.shard), run.plan.shard->count)));
  }
  records::BaselineSection section;
  section.key = {records::section_name(backend), in_environment(run, "architecture"), "", ""};
  section.rules_version = run.rules_version;
  section.plan = records::frozen(run.plan);
  section.taken = {backend, in_environment(run, "version"), "",
                   in_environment(run, "instruction_set"), in_environment(run, "compiler")};
  section.entries = entries_of(run, backend);
  for (const std::string& law : run.plan.laws) section.laws[law];
  add_cases(section, *run.cases, backend);
  std::copy_if(run.specimens.begin(), run.specimens.end(), std::back_inserter(section.specimens),
               [&backend](const records::Specimen& one) { return one.key.backend == backend; });
  return section;
}

Result<records::Baseline> baseline_of(const records::Run& run) {
  records::Baseline baseline;
  for (const std::string& backend : run.plan.backends) {
    Result<records::BaselineSection> section = section_of(run, backend);
    if (!section) return tl::unexpected(section.error());
    const auto& all = baseline.sections;
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&section](const auto& one) { return one.key == section->key; });
    if (same != all.end()) {
      return tl::unexpected(
          refusal(fmt::format("the backends '{}' and '{}' have the same name in a baseline",
                              same->taken.backend, backend)));
    }
    put(baseline, *std::move(section));
  }
  return baseline;
}

Result<void> add_cases(records::BaselineSection& section, const records::Run& run,
                       const std::string& backend) {
  const Result<records::BaselineSection> more = section_of(run, backend);
  if (!more) return tl::unexpected(more.error());
  for (const auto& [key, figures] : more->entries) merge(section.entries[key], figures);
  for (const auto& [id, from] : more->laws) {
    records::LawCases& law = section.laws[id];
    law.count += from.count;
    law.digest += from.digest;
    law.cases.insert(from.cases.begin(), from.cases.end());
  }
  section.corpus.insert(more->corpus.begin(), more->corpus.end());
  return {};
}

const records::BaselineSection* find_section(const records::Baseline& baseline,
                                             const records::BaselineSection& current) {
  const auto matches = [](const std::string& asked, const std::string& is) {
    return asked.empty() || asked == is;
  };
  const records::BaselineSection* found = nullptr;
  const auto specificity = [](const records::BaselineKey& key) {
    return std::pair(!key.instruction_set.empty(), !key.compiler.empty());
  };
  for (const records::BaselineSection& section : baseline.sections) {
    const records::BaselineKey& key = section.key;
    if (key.backend != current.key.backend || key.architecture != current.key.architecture ||
        !matches(key.instruction_set, current.taken.instruction_set) ||
        !matches(key.compiler, current.taken.compiler)) {
      continue;
    }
    if (found == nullptr || specificity(key) > specificity(found->key)) found = &section;
  }
  return found;
}

}  // namespace rastercheck::gate
