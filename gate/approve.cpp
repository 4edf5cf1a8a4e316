#include "gate/approve.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "reports/compare_text.h"

namespace rastercheck::gate {
namespace {

bool fits(const std::string& pattern, std::string_view text) {
  return ::fnmatch(pattern.c_str(), std::string(text).c_str(), 0) == 0;
}

using StrataErrors = std::map<records::Stratum, records::WorstError>;

/// Returns the errors of one stratum, or of all if none is given.
StrataErrors only(const StrataErrors& errors, std::optional<records::Stratum> stratum) {
  if (!stratum) return errors;
  const auto found = errors.find(*stratum);
  return found == errors.end() ? StrataErrors() : StrataErrors{*found};
}

/// Accepts the worst errors of one kind, in one stratum or in all, for all cases of a law.
void take_worst(records::LawCases& into, const records::LawCases& from, records::AttributeKind kind,
                std::optional<records::Stratum> stratum) {
  for (auto& [number, figures] : into.cases) {
    StrataErrors& errors = figures.worst[kind];
    for (const auto& [each, worst] : only(errors, stratum)) errors.erase(each);
    if (const auto now = from.cases.find(number); now != from.cases.end()) {
      const auto of_kind = now->second.worst.find(kind);
      if (of_kind != now->second.worst.end()) errors.merge(only(of_kind->second, stratum));
    }
    if (errors.empty()) figures.worst.erase(kind);
  }
}

/// Accepts the set of cases that the law applies to, and their outcomes and mismatches. A case that
/// was not applicable before is accepted whole, as it has no earlier results to keep.
void take_outcomes(records::LawCases& into, const records::LawCases& from) {
  std::map<records::CaseNumber, records::CaseFigures> cases = from.cases;
  for (auto& [number, figures] : cases) {
    const auto before = into.cases.find(number);
    if (before == into.cases.end()) continue;
    figures.found_digest = before->second.found_digest;
    figures.worst = before->second.worst;
  }
  into.cases = std::move(cases);
}

/// Accepts one entry, and the results of its law's cases that belong to it.
void take_entry(records::BaselineSection& section, const records::BaselineSection& current,
                const records::EntryKey& key) {
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
  records::LawCases& law = section.laws[key.law];
  if (is_new) law = now->second;
  if (key.kind == records::AttributeKind::coverage) take_outcomes(law, now->second);
  take_worst(law, now->second, key.kind, key.stratum);
}

/// Accepts all cases of a law if every change of the law was accepted: the cases' remaining results
/// belong to the accepted changes.
void take_finished_laws(records::BaselineSection& section, const records::BaselineSection& current,
                        const std::vector<records::EntryChange>& all,
                        const std::vector<records::EntryChange>& taken) {
  for (const records::EntryChange& entry : taken) {
    const std::string& law = entry.key.law;
    const auto now = current.laws.find(law);
    if (now == current.laws.end()) continue;
    const auto of_law = [&law](const std::map<records::EntryKey, records::EntryFigures>& entries) {
      std::map<records::EntryKey, records::EntryFigures> some;
      for (const auto& [key, figures] : entries) {
        if (key.law == law) some.emplace(key, figures);
      }
      return some;
    };
    // An entry's figures may be equal although its cases changed, so changes are counted as well.
    const auto changed_of_law = [&law](const std::vector<records::EntryChange>& entries) {
      return std::count_if(entries.begin(), entries.end(), [&law](const records::EntryChange& one) {
        return one.key.law == law && one.change != records::Change::same;
      });
    };
    if (of_law(section.entries) == of_law(current.entries) &&
        changed_of_law(all) == changed_of_law(taken)) {
      section.laws[law] = now->second;
    }
  }
}

void take_all(records::BaselineSection& section, const records::BaselineSection& current) {
  records::BaselineSection taken = current;
  taken.key = section.key;
  taken.approvals = std::move(section.approvals);
  section = std::move(taken);
}

}  // namespace

bool EntryPattern::matches(const records::EntryKey& key) const {
  const bool is_of_stratum =
      fits(stratum, "all") || (key.stratum && fits(stratum, to_string(*key.stratum)));
  return fits(law, key.law) && fits(kind, to_string(key.kind)) && is_of_stratum;
}

std::map<std::string, std::uint64_t> violations_taken(const records::Comparison& comparison,
                                                      const EntryPattern& pattern) {
  std::map<std::string, std::uint64_t> taken;
  for (const records::EntryChange& entry : comparison.entries) {
    const std::uint64_t violations = entry.after.cases.violations;
    const bool is_more = entry.change == records::Change::appeared ||
                         std::any_of(entry.figures.begin(), entry.figures.end(),
                                     [](const records::FigureChange& one) {
                                       return one.figure == records::Figure::grown_cases ||
                                              (one.figure == records::Figure::violations &&
                                               one.change == records::Change::worse);
                                     });
    if (is_more && violations > 0 && pattern.matches(entry.key)) taken[entry.key.law] = violations;
  }
  return taken;
}

std::vector<std::string> approve(records::BaselineSection& section,
                                 const records::BaselineSection& current,
                                 const records::Comparison& comparison, const EntryPattern& pattern,
                                 const std::string& reason) {
  std::vector<records::EntryChange> taken;
  for (const records::EntryChange& entry : comparison.entries) {
    if (entry.change != records::Change::same && pattern.matches(entry.key)) taken.push_back(entry);
  }
  std::vector<std::string> changes = reports::change_lines(taken);
  if (changes.empty() && pattern.is_all() && comparison.changed_cases > 0) {
    changes.push_back(fmt::format("{} of {} cases drew other bits, but no number changed",
                                  comparison.changed_cases, comparison.compared_cases));
  }
  if (changes.empty()) return changes;
  if (pattern.is_all()) {
    take_all(section, current);
  } else {
    for (const records::EntryChange& entry : taken) take_entry(section, current, entry.key);
    take_finished_laws(section, current, comparison.entries, taken);
    // Adds the names of corpus cases that came with new laws.
    section.corpus.insert(current.corpus.begin(), current.corpus.end());
  }
  section.approvals.push_back({reason, current.taken.version, current.taken.commit, changes});
  return changes;
}

}  // namespace rastercheck::gate
