#include "reports/internal/compare_cases.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace rastercheck::reports {
namespace {

using records::Enclosure;
using records::WorstError;

/// A number to order growths by; what they are is shown as both errors.
double growth_of(const CaseGrowth& growth) {
  if (!growth.after) return 0;
  const double before = growth.before ? records::magnitude_bound(growth.before->error) : 0;
  return records::magnitude_bound(growth.after->error) - before;
}

const WorstError* worst_in(const CaseFigures& figures, records::AttributeKind kind,
                           records::Stratum stratum) {
  const auto of_kind = figures.worst.find(kind);
  if (of_kind == figures.worst.end()) return nullptr;
  const auto found = of_kind->second.find(stratum);
  return found == of_kind->second.end() ? nullptr : &found->second;
}

Enclosure size_of(const WorstError* worst) {
  return worst == nullptr ? Enclosure() : records::magnitude(worst->error);
}

/// The error of the case that grew most, if one did.
void find_grown_error(const CaseFigures& before, const CaseFigures& after, CaseGrowth& growth) {
  for (const auto& [kind, strata] : after.worst) {
    for (const auto& [stratum, is] : strata) {
      const WorstError* was = worst_in(before, kind, stratum);
      if (!is_larger(size_of(&is), size_of(was))) continue;
      CaseGrowth candidate = growth;
      candidate.kind = kind;
      candidate.stratum = stratum;
      candidate.before = was == nullptr ? std::nullopt : std::optional(*was);
      candidate.after = is;
      if (!growth.after || growth_of(candidate) > growth_of(growth)) growth = candidate;
    }
  }
}

/// The larger of all strata of a kind.
Enclosure size_in(const CaseFigures& figures, records::AttributeKind kind) {
  Enclosure largest;
  const auto strata = figures.worst.find(kind);
  if (strata == figures.worst.end()) return largest;
  for (const auto& [stratum, worst] : strata->second) {
    if (is_larger(size_of(&worst), largest)) largest = size_of(&worst);
  }
  return largest;
}

void count_growth(const std::string& law, const CaseFigures& before, const CaseFigures& after,
                  std::map<EntryKey, std::uint64_t>& counts) {
  if (after.mismatches > before.mismatches) {
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

auto place_of(const CaseGrowth& growth) {
  return std::tie(growth.law, growth.origin, growth.index);
}

bool goes_before(const CaseGrowth& a, const CaseGrowth& b) {
  const auto wrong = [](const CaseGrowth& growth) {
    return growth.mismatches_after > growth.mismatches_before
               ? growth.mismatches_after - growth.mismatches_before
               : 0;
  };
  if (wrong(a) != wrong(b)) return wrong(a) > wrong(b);
  const double by = growth_of(a);
  const double other = growth_of(b);
  if (by != other) return by > other;
  return place_of(a) < place_of(b);
}

class CaseComparer {
 public:
  CaseComparer(const BaselineSection& after, Comparison& comparison)
      : after_(after), comparison_(comparison) {}

  void compare(const std::string& law, const LawCases& before, const LawCases& after) {
    comparison_.compared_cases += after.count;
    for (const auto& [number, was] : before.cases) {
      const auto is = after.cases.find(number);
      if (is == after.cases.end()) {
        ++comparison_.changed_cases;  // of which the law says nothing any more
      } else if (is->second != was) {
        ++comparison_.changed_cases;
        compare(law, number, was, is->second);
      }
    }
    for (const auto& [number, is] : after.cases) {
      if (!before.cases.contains(number)) ++comparison_.changed_cases;
    }
  }

 private:
  void compare(const std::string& law, const CaseNumber& number, const CaseFigures& was,
               const CaseFigures& is) {
    CaseGrowth growth;
    growth.law = law;
    std::tie(growth.origin, growth.index) = number;
    if (growth.origin == records::Origin::corpus) {
      const auto name = after_.corpus.find(growth.index);
      if (name != after_.corpus.end()) growth.name = name->second;
    }
    growth.mismatches_before = was.mismatches;
    growth.mismatches_after = is.mismatches;
    find_grown_error(was, is, growth);
    if (growth.after || is.mismatches > was.mismatches) {
      comparison_.growths.push_back(std::move(growth));
    }
  }

  const BaselineSection& after_;
  Comparison& comparison_;
};

}  // namespace

bool is_larger(const Enclosure& a, const Enclosure& b) {
  return std::pair(a.hi, a.lo) > std::pair(b.hi, b.lo);
}

std::map<EntryKey, std::uint64_t> grown_cases(const BaselineSection& before,
                                              const BaselineSection& after) {
  std::map<EntryKey, std::uint64_t> counts;
  for (const auto& [law, cases] : before.laws) {
    const auto now = after.laws.find(law);
    if (now == after.laws.end()) continue;
    for (const auto& [number, was] : cases.cases) {
      const auto is = now->second.cases.find(number);
      if (is != now->second.cases.end()) count_growth(law, was, is->second, counts);
    }
  }
  return counts;
}

void compare_cases(const BaselineSection& before, const BaselineSection& after,
                   const CompareOptions& options, Comparison& comparison) {
  CaseComparer comparer(after, comparison);
  for (const auto& [law, cases] : before.laws) {
    const auto now = after.laws.find(law);
    if (now != after.laws.end()) comparer.compare(law, cases, now->second);
  }
  std::vector<CaseGrowth>& growths = comparison.growths;
  comparison.grown_cases = growths.size();
  std::sort(growths.begin(), growths.end(), goes_before);
  if (growths.size() > options.most_growths) growths.resize(options.most_growths);
}

}  // namespace rastercheck::reports
