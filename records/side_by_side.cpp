#include "records/side_by_side.h"

#include <array>
#include <map>
#include <utility>

#include "records/enclosure.h"

namespace rastercheck::records {
namespace {

/// The two sides' outcomes of one law's cases from one origin.
struct Sides {
  const CaseOutcomes* first = nullptr;
  const CaseOutcomes* second = nullptr;
};

const CaseOutcomes* outcomes_of(const Run& run, const std::string& law, const std::string& backend,
                                Origin origin) {
  const auto found = run.outcomes->find({law, backend, origin});
  return found == run.outcomes->end() ? nullptr : &found->second;
}

/// Returns the cases that are the same on both sides and were judged on both.
IndexSet same_cases(const Sides& sides, const std::string& first, SideBySide& pair) {
  if (sides.first != nullptr) pair.judged_first += judged_of(*sides.first).count();
  if (sides.second != nullptr) pair.judged_second += judged_of(*sides.second).count();
  if (sides.first == nullptr || sides.second == nullptr) return {};
  IndexSet judged = common(judged_of(*sides.first), judged_of(*sides.second));
  const auto unlike = sides.second->unlike.find(first);
  if (unlike == sides.second->unlike.end()) return judged;
  pair.unlike += common(judged, unlike->second).count();
  return without(judged, unlike->second);
}

void append(std::vector<CasePlace>& places, Origin origin, const IndexSet& cases) {
  if (places.size() >= kMostPlaces) return;
  for (const std::uint64_t index : cases.first(kMostPlaces - places.size())) {
    places.push_back({origin, index});
  }
}

/// Counts a law's cases from one origin.
void add_cases(const Sides& sides, Origin origin, const IndexSet& same, SideBySideLaw& law,
               SideBySide& pair) {
  if (same.empty()) return;
  const IndexSet first = common(same, sides.first->right);
  const IndexSet second = common(same, sides.second->right);
  const IndexSet only_first = without(first, second);
  const IndexSet only_second = without(second, first);
  const std::uint64_t both = common(first, second).count();
  law.counts.both_right += both;
  law.counts.only_first_right += only_first.count();
  law.counts.only_second_right += only_second.count();
  law.counts.neither_right += same.count() - both - only_first.count() - only_second.count();
  append(law.only_first_right, origin, only_first);
  append(law.only_second_right, origin, only_second);
  pair.known_first += common(same, sides.first->known).count();
  pair.known_second += common(same, sides.second->known).count();
}

std::optional<Enclosure> larger(const std::optional<Enclosure>& a, const Enclosure& b) {
  return a && std::pair(a->hi, a->lo) >= std::pair(b.hi, b.lo) ? a : b;
}

/// Returns the largest excess of each kind of value that a backend has.
std::map<AttributeKind, Enclosure> excess_of(const Run& run, const std::string& backend) {
  std::map<AttributeKind, Enclosure> all;
  for (const auto& [key, record] : run.records) {
    const ErrorSizes& excess = record.errors.excess;
    if (key.backend != backend || key.attribute_kind == AttributeKind::coverage ||
        excess.histogram.count() + excess.histogram.non_finite() == 0) {
      continue;
    }
    Enclosure& largest = all.try_emplace(key.attribute_kind).first->second;
    if (const WorstError* worst = worst_of(excess.extremes)) {
      largest = *larger(largest, magnitude(worst->error));
    }
  }
  return all;
}

std::vector<SideErrors> errors_of(const Run& run, const SideBySide& pair) {
  std::map<AttributeKind, SideErrors> all;
  for (const auto& [kind, error] : excess_of(run, pair.first)) all[kind].first = error;
  for (const auto& [kind, error] : excess_of(run, pair.second)) all[kind].second = error;
  std::vector<SideErrors> errors;
  for (auto& [kind, error] : all) {
    error.kind = kind;
    errors.push_back(error);
  }
  return errors;
}

SideBySide compared(const Run& run, const std::string& first, const std::string& second) {
  SideBySide pair;
  pair.first = first;
  pair.second = second;
  for (const std::string& law : run.plan.laws) {
    SideBySideLaw row{law, {}, {}, {}};
    for (const Origin origin : {Origin::corpus, Origin::random}) {
      const Sides sides{outcomes_of(run, law, first, origin),
                        outcomes_of(run, law, second, origin)};
      add_cases(sides, origin, same_cases(sides, first, pair), row, pair);
    }
    if (row.counts.cases() == 0) continue;
    pair.counts.both_right += row.counts.both_right;
    pair.counts.only_first_right += row.counts.only_first_right;
    pair.counts.only_second_right += row.counts.only_second_right;
    pair.counts.neither_right += row.counts.neither_right;
    pair.laws.push_back(std::move(row));
  }
  pair.errors = errors_of(run, pair);
  return pair;
}

}  // namespace

std::vector<SideBySide> side_by_side(const Run& run) {
  if (!run.outcomes || run.plan.shard) return {};
  const std::vector<std::string>& backends = run.plan.backends;
  std::vector<SideBySide> pairs;
  for (std::size_t first = 0; first < backends.size(); ++first) {
    for (std::size_t second = first + 1; second < backends.size(); ++second) {
      if (first > 0 && backends.size() > kMostInAllPairs) break;
      pairs.push_back(compared(run, backends[first], backends[second]));
    }
  }
  return pairs;
}

}  // namespace rastercheck::records
