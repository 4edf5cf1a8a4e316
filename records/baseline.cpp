#include "records/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

namespace rastercheck::records {

std::string section_name(const std::string& backend) {
  constexpr std::string_view kPlugin = "plugin:";
  if (!backend.starts_with(kPlugin)) return backend;
  const std::filesystem::path path(backend.substr(kPlugin.size()));
  return std::string(kPlugin) + path.lexically_normal().string();
}

bool are_outcomes_known(const BaselineSection& section, const std::string& law) {
  const auto of = section.laws.find(law);
  const auto entry = section.entries.find({law, AttributeKind::coverage, std::nullopt});
  if (of == section.laws.end() || entry == section.entries.end()) return false;
  CaseCounts counts;
  for (const auto& [number, figures] : of->second.cases) {
    if (figures.outcome == CaseOutcome::violated) ++counts.violations;
    if (figures.outcome == CaseOutcome::known) ++counts.known;
  }
  return counts.violations == entry->second.cases.violations &&
         counts.known == entry->second.cases.known;
}

void merge(EntryFigures& into, const EntryFigures& from) {
  merge(into.cases, from.cases);
  merge(into.power, from.power);
  merge(into.classes, from.classes);
  if (from.not_judged) into.not_judged = into.not_judged.value_or(0) + *from.not_judged;
  into.histogram.merge(from.histogram);
  // As keep() of record.h orders errors: by the far end first.
  const auto extent = [](const Enclosure& size) { return std::pair(size.hi, size.lo); };
  into.worst = std::max(into.worst, from.worst,
                        [&extent](const auto& a, const auto& b) { return extent(a) < extent(b); });
  for (const auto& [stage, sum] : from.stages) into.stages[stage].merge(sum);
}

void put(Baseline& baseline, BaselineSection section) {
  const auto at = std::lower_bound(
      baseline.sections.begin(), baseline.sections.end(), section.key,
      [](const BaselineSection& one, const BaselineKey& key) { return one.key < key; });
  if (at != baseline.sections.end() && at->key == section.key) {
    *at = std::move(section);
  } else {
    baseline.sections.insert(at, std::move(section));
  }
}

std::string to_string(const BaselineKey& key) {
  std::string text = fmt::format("{} on {}", key.backend, key.architecture);
  if (!key.instruction_set.empty()) text += ", " + key.instruction_set;
  if (!key.compiler.empty()) text += ", " + key.compiler;
  return text;
}

std::string to_string(const EntryKey& key) {
  std::string text = fmt::format("{}: {}", key.law, to_string(key.kind));
  if (key.stratum) text += fmt::format(", {}", to_string(*key.stratum));
  return text;
}

}  // namespace rastercheck::records
