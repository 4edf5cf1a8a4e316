#include "gate/internal/compare_cases.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace rastercheck::gate {
namespace {

using records::CaseOutcome;
using records::Enclosure;
using records::WorstError;

/// Returns the size of a growth for ordering only; reports show both errors.
double size_of_growth(const records::CaseGrowth& growth) {
  if (!growth.after) return 0;
  const double before = growth.before ? records::magnitude_bound(growth.before->error) : 0;
  return records::magnitude_bound(growth.after->error) - before;
}

const WorstError* worst_in(const records::CaseFigures& figures, records::AttributeKind kind,
                           records::Stratum stratum) {
  const auto of_kind = figures.worst.find(kind);
  if (of_kind == figures.worst.end()) return nullptr;
  const auto found = of_kind->second.find(stratum);
  return found == of_kind->second.end() ? nullptr : &found->second;
}

Enclosure size_of(const WorstError* worst) {
  return worst == nullptr ? Enclosure() : records::magnitude(worst->error);
}

/// Ranks a growth by its reference: 2 if there was an error before, 1 if none is known (every error
/// 0, or nothing judged), 0 if there is no error now.
int footing(const records::CaseGrowth& growth) { return !growth.after ? 0 : growth.before ? 2 : 1; }

/// True if the first error grew more, as far as this can be decided.
bool grew_more(const records::CaseGrowth& a, const records::CaseGrowth& b) {
  return std::pair(footing(a), size_of_growth(a)) > std::pair(footing(b), size_of_growth(b));
}

/// Finds the case's error that grew most, if any grew.
void find_grown_error(const records::CaseFigures& before, const records::CaseFigures& after,
                      records::CaseGrowth& growth) {
  for (const auto& [kind, strata] : after.worst) {
    for (const auto& [stratum, is] : strata) {
      const WorstError* was = worst_in(before, kind, stratum);
      if (!is_larger(size_of(&is), size_of(was))) continue;
      records::CaseGrowth candidate = growth;
      candidate.kind = kind;
      candidate.stratum = stratum;
      candidate.before = was == nullptr ? std::nullopt : std::optional(*was);
      candidate.after = is;
      if (grew_more(candidate, growth)) growth = candidate;
    }
  }
}

/// Returns the largest error of a kind in all strata.
Enclosure size_in(const records::CaseFigures& figures, records::AttributeKind kind) {
  Enclosure largest;
  const auto strata = figures.worst.find(kind);
  if (strata == figures.worst.end()) return largest;
  for (const auto& [stratum, worst] : strata->second) {
    if (is_larger(size_of(&worst), largest)) largest = size_of(&worst);
  }
  return largest;
}

/// Ranks outcomes from best to worst.
int badness(CaseOutcome outcome) {
  return outcome == CaseOutcome::violated ? 2 : outcome == CaseOutcome::known ? 1 : 0;
}

bool is_worse(CaseOutcome after, CaseOutcome before) { return badness(after) > badness(before); }

/// The cases of a law before and after.
struct LawPair {
  const records::LawCases& before;
  const records::LawCases& after;
  bool are_outcomes_known = false;  ///< on both sides

  CaseOutcome outcome(const records::CaseFigures& figures) const {
    return are_outcomes_known ? figures.outcome : CaseOutcome::held;
  }
  bool are_same(records::CaseFigures was, const records::CaseFigures& is) const {
    if (!are_outcomes_known) was.outcome = is.outcome;
    return was == is;
  }
};

/// Returns all laws that both sections have.
std::map<std::string, LawPair> law_pairs(const records::BaselineSection& before,
                                         const records::BaselineSection& after) {
  std::map<std::string, LawPair> pairs;
  for (const auto& [law, cases] : before.laws) {
    const auto now = after.laws.find(law);
    if (now == after.laws.end()) continue;
    const bool are_known = are_outcomes_known(before, law) && are_outcomes_known(after, law);
    pairs.emplace(law, LawPair{cases, now->second, are_known});
  }
  return pairs;
}

void count_growth(const std::string& law, const LawPair& pair, const records::CaseFigures& before,
                  const records::CaseFigures& after,
                  std::map<records::EntryKey, std::uint64_t>& counts) {
  if (after.mismatches > before.mismatches || is_worse(pair.outcome(after), pair.outcome(before))) {
    ++counts[{law, records::AttributeKind::coverage, std::nullopt}];
  }
  for (const auto& [kind, strata] : after.worst) {
    if (is_larger(size_in(after, kind), size_in(before, kind))) {
      ++counts[{law, kind, std::nullopt}];
    }
    for (const auto& [stratum, worst] : strata) {
      if (is_larger(size_of(&worst), size_of(worst_in(before, kind, stratum)))) {
        ++counts[{law, kind, stratum}];
      }
    }
  }
}

auto place_of_growth(const records::CaseGrowth& growth) {
  return std::tie(growth.law, growth.origin, growth.index);
}

bool goes_before(const records::CaseGrowth& a, const records::CaseGrowth& b) {
  const auto wrong = [](const records::CaseGrowth& growth) {
    return growth.mismatches_after > growth.mismatches_before
               ? growth.mismatches_after - growth.mismatches_before
               : 0;
  };
  const auto is_worse_off = [](const records::CaseGrowth& growth) {
    return is_worse(growth.outcome_after, growth.outcome_before);
  };
  if (is_worse_off(a) != is_worse_off(b)) return is_worse_off(a);
  if (wrong(a) != wrong(b)) return wrong(a) > wrong(b);
  if (grew_more(a, b) || grew_more(b, a)) return grew_more(a, b);
  return place_of_growth(a) < place_of_growth(b);
}

class CaseComparer {
 public:
  CaseComparer(const records::BaselineSection& after, records::Comparison& comparison)
      : after_(after), comparison_(comparison) {}

  void compare(const std::string& law, const LawPair& pair) {
    comparison_.compared_cases += pair.after.count;
    for (const auto& [number, was] : pair.before.cases) {
      const auto is = pair.after.cases.find(number);
      if (is == pair.after.cases.end()) {
        ++comparison_.changed_cases;  // the law no longer applies
      } else if (!pair.are_same(was, is->second)) {
        ++comparison_.changed_cases;
        compare(law, number, pair, was, is->second);
      }
    }
    for (const auto& [number, is] : pair.after.cases) {
      if (pair.before.cases.contains(number)) continue;
      ++comparison_.changed_cases;
      if (!is_worse(is.outcome, CaseOutcome::not_applicable)) continue;
      records::CaseGrowth growth = growth_of_case(law, number);
      growth.mismatches_after = is.mismatches;
      growth.outcome_before = CaseOutcome::not_applicable;
      growth.outcome_after = is.outcome;
      comparison_.growths.push_back(std::move(growth));
    }
  }

 private:
  records::CaseGrowth growth_of_case(const std::string& law,
                                     const records::CaseNumber& number) const {
    records::CaseGrowth growth;
    growth.law = law;
    std::tie(growth.origin, growth.index) = number;
    if (growth.origin == records::Origin::corpus) {
      const auto name = after_.corpus.find(growth.index);
      if (name != after_.corpus.end()) growth.name = name->second;
    }
    return growth;
  }

  void compare(const std::string& law, const records::CaseNumber& number, const LawPair& pair,
               const records::CaseFigures& was, const records::CaseFigures& is) {
    records::CaseGrowth growth = growth_of_case(law, number);
    growth.mismatches_before = was.mismatches;
    growth.mismatches_after = is.mismatches;
    growth.outcome_before = pair.outcome(was);
    growth.outcome_after = pair.outcome(is);
    find_grown_error(was, is, growth);
    if (growth.after || is.mismatches > was.mismatches ||
        is_worse(growth.outcome_after, growth.outcome_before)) {
      comparison_.growths.push_back(std::move(growth));
    }
  }

  const records::BaselineSection& after_;
  records::Comparison& comparison_;
};

}  // namespace

bool is_larger(const Enclosure& a, const Enclosure& b) {
  return std::pair(a.hi, a.lo) > std::pair(b.hi, b.lo);
}

std::map<records::EntryKey, std::uint64_t> grown_cases(const records::BaselineSection& before,
                                                       const records::BaselineSection& after) {
  std::map<records::EntryKey, std::uint64_t> counts;
  for (const auto& [law, pair] : law_pairs(before, after)) {
    for (const auto& [number, was] : pair.before.cases) {
      const auto is = pair.after.cases.find(number);
      if (is != pair.after.cases.end()) count_growth(law, pair, was, is->second, counts);
    }
    // Errors of a case that was not applicable before have no reference.
    for (const auto& [number, is] : pair.after.cases) {
      if (pair.before.cases.contains(number)) continue;
      if (is_worse(is.outcome, CaseOutcome::not_applicable)) {
        ++counts[{law, records::AttributeKind::coverage, std::nullopt}];
      }
    }
  }
  return counts;
}

void compare_cases(const records::BaselineSection& before, const records::BaselineSection& after,
                   const CompareOptions& options, records::Comparison& comparison) {
  CaseComparer comparer(after, comparison);
  for (const auto& [law, pair] : law_pairs(before, after)) comparer.compare(law, pair);
  std::vector<records::CaseGrowth>& growths = comparison.growths;
  comparison.grown_cases = growths.size();
  std::sort(growths.begin(), growths.end(), goes_before);
  if (growths.size() > options.most_growths) growths.resize(options.most_growths);
}

}  // namespace rastercheck::gate
