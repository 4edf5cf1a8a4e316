#include "reports/approve.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>

#include "reports/compare_text.h"

namespace rastercheck::reports {
namespace {

bool fits(const std::string& pattern, std::string_view text) {
  return ::fnmatch(pattern.c_str(), std::string(text).c_str(), 0) == 0;
}

/// The worst errors of one kind and stratum, of all cases of a law.
void take_worst(LawCases& into, const LawCases& from, records::AttributeKind kind,
                records::Stratum stratum) {
  for (auto& [number, figures] : into.cases) {
    if (const auto of_kind = figures.worst.find(kind); of_kind != figures.worst.end()) {
      of_kind->second.erase(stratum);
      if (of_kind->second.empty()) figures.worst.erase(of_kind);
    }
    const auto now = from.cases.find(number);
    if (now == from.cases.end()) continue;
    const auto of_kind = now->second.worst.find(kind);
    if (of_kind == now->second.worst.end()) continue;
    const auto worst = of_kind->second.find(stratum);
    if (worst != of_kind->second.end()) figures.worst[kind][stratum] = worst->second;
  }
}

void take_mismatches(LawCases& into, const LawCases& from) {
  for (auto& [number, figures] : into.cases) {
    const auto now = from.cases.find(number);
    if (now != from.cases.end()) figures.mismatches = now->second.mismatches;
  }
}

/// One entry, and what its law's cases have of it.
void take_entry(BaselineSection& section, const BaselineSection& current, const EntryKey& key) {
  const auto figures = current.entries.find(key);
  if (figures == current.entries.end()) {
    section.entries.erase(key);
  } else {
    section.entries[key] = figures->second;
  }
  const auto now = current.laws.find(key.law);
  if (now == current.laws.end()) {
    // The law is gone; its cases go with the last of its entries.
    const bool is_left = std::any_of(section.entries.begin(), section.entries.end(),
                                     [&key](const auto& one) { return one.first.law == key.law; });
    if (!is_left) section.laws.erase(key.law);
    return;
  }
  const bool is_new = !section.laws.contains(key.law);
  LawCases& law = section.laws[key.law];
  if (is_new) law = now->second;
  if (key.kind == records::AttributeKind::coverage) take_mismatches(law, now->second);
  if (key.stratum) take_worst(law, now->second, key.kind, *key.stratum);
}

/// Of a law of which all that changed was taken, all of its cases: what else they gave belongs to
/// what was approved.
void take_finished_laws(BaselineSection& section, const BaselineSection& current,
                        const std::vector<EntryChange>& all,
                        const std::vector<EntryChange>& taken) {
  for (const EntryChange& entry : taken) {
    const std::string& law = entry.key.law;
    const auto now = current.laws.find(law);
    if (now == current.laws.end()) continue;
    const auto of_law = [&law](const std::map<EntryKey, EntryFigures>& entries) {
      std::map<EntryKey, EntryFigures> some;
      for (const auto& [key, figures] : entries) {
        if (key.law == law) some.emplace(key, figures);
      }
      return some;
    };
    // An entry may have changed by its cases alone.
    const auto changed_of_law = [&law](const std::vector<EntryChange>& entries) {
      return std::count_if(entries.begin(), entries.end(), [&law](const EntryChange& one) {
        return one.key.law == law && one.change != Change::same;
      });
    };
    if (of_law(section.entries) == of_law(current.entries) &&
        changed_of_law(all) == changed_of_law(taken)) {
      section.laws[law] = now->second;
    }
  }
}

void take_all(BaselineSection& section, const BaselineSection& current) {
  BaselineSection taken = current;
  taken.key = section.key;
  taken.approvals = std::move(section.approvals);
  section = std::move(taken);
}

}  // namespace

bool EntryPattern::matches(const EntryKey& key) const {
  return fits(law, key.law) && fits(kind, to_string(key.kind)) &&
         fits(stratum, key.stratum ? to_string(*key.stratum) : "all");
}

std::vector<std::string> approve(BaselineSection& section, const BaselineSection& current,
                                 const Comparison& comparison, const EntryPattern& pattern,
                                 const std::string& reason) {
  std::vector<EntryChange> taken;
  for (const EntryChange& entry : comparison.entries) {
    if (entry.change != Change::same && pattern.matches(entry.key)) taken.push_back(entry);
  }
  std::vector<std::string> changes = change_lines(taken);
  if (changes.empty() && pattern.is_all() && comparison.changed_cases > 0) {
    changes.push_back(fmt::format("{} of {} cases gave other bits, and no figure changed",
                                  comparison.changed_cases, comparison.compared_cases));
  }
  if (changes.empty()) return changes;
  if (pattern.is_all()) {
    take_all(section, current);
  } else {
    for (const EntryChange& entry : taken) take_entry(section, current, entry.key);
    take_finished_laws(section, current, comparison.entries, taken);
    // Names of cases that new laws brought.
    section.corpus.insert(current.corpus.begin(), current.corpus.end());
  }
  section.approvals.push_back({reason, current.taken.version, current.taken.commit, changes});
  return changes;
}

}  // namespace rastercheck::reports
