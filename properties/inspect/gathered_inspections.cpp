#include "properties/inspect/gathered_inspections.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "properties/campaign/findings.h"
#include "records/histogram.h"

namespace rastercheck::properties {
namespace {

using records::Inspection;
using records::Occasion;

/// Returns the size of the inspected error; empty if there is none.
std::optional<double> size_of(const Inspection& inspection) {
  const records::InspectedSample* sample = records::inspected_sample(inspection);
  const std::size_t value = inspection.attribute ? 1 + std::size_t{*inspection.attribute} : 0;
  if (sample == nullptr || value >= sample->values.size()) return std::nullopt;
  const auto& error = sample->values[value].scale_error;
  return error ? std::optional(records::magnitude_bound(*error)) : std::nullopt;
}

/// Returns the shards' inspection of a counterexample; nullptr if there is none.
const Inspection* find_inspection(const records::Counterexample& one,
                                  std::span<const MergedRun::LookedAt> shards) {
  for (const MergedRun::LookedAt& shard : shards) {
    for (const Inspection& inspection : shard.inspections) {
      if (inspection.occasion != Occasion::counterexample) continue;
      if (inspection.counterexample >= shard.counterexamples.size()) continue;
      if (shard.counterexamples[inspection.counterexample] == one) return &inspection;
    }
  }
  return nullptr;
}

struct Worst {
  double size = 0;
  const Inspection* inspection = nullptr;
};

/// Orders errors as inspect_run() prefers them.
bool is_preferred(const Worst& a, const Worst& b) {
  const auto rank = [](const Worst& one) {
    const Inspection& inspection = *one.inspection;
    return std::tuple(-one.size, inspection.law != kValuesLaw, inspection.law);
  };
  return rank(a) < rank(b);
}

/// Returns the largest error of each backend, kind and stratum, the largest first.
std::vector<Worst> worst_of(std::span<const MergedRun::LookedAt> shards) {
  using Key = std::tuple<std::string, records::AttributeKind, records::Stratum>;
  std::map<Key, Worst> largest;
  for (const MergedRun::LookedAt& shard : shards) {
    for (const Inspection& inspection : shard.inspections) {
      if (inspection.occasion != Occasion::worst) continue;
      const std::optional<double> size = size_of(inspection);
      if (!size || !inspection.kind || !inspection.stratum) continue;
      const Worst one{*size, &inspection};
      Worst& kept = largest[{inspection.backend, *inspection.kind, *inspection.stratum}];
      if (kept.inspection == nullptr || is_preferred(one, kept)) kept = one;
    }
  }
  std::vector<Worst> all;
  all.reserve(largest.size());
  for (const auto& [key, worst] : largest) all.push_back(worst);
  std::stable_sort(all.begin(), all.end(),
                   [](const Worst& a, const Worst& b) { return a.size > b.size; });
  return all;
}

}  // namespace

std::vector<Inspection> gathered_inspections(const records::Run& run,
                                             std::span<const MergedRun::LookedAt> shards) {
  std::vector<Inspection> inspections;
  for (std::size_t i = 0; i < run.counterexamples.size(); ++i) {
    if (inspections.size() == records::kMostInspections) return inspections;
    const Inspection* found = find_inspection(run.counterexamples[i], shards);
    if (found == nullptr) continue;
    inspections.push_back(*found);
    inspections.back().counterexample = i;
  }
  std::vector<Worst> worst = worst_of(shards);
  worst.resize(std::min(worst.size(), records::kMostInspections - inspections.size()));
  std::sort(worst.begin(), worst.end(), [](const Worst& a, const Worst& b) {
    const auto key = [](const Inspection& one) {
      return std::tie(one.law, one.backend, one.kind, one.stratum);
    };
    return key(*a.inspection) < key(*b.inspection);
  });
  std::transform(worst.begin(), worst.end(), std::back_inserter(inspections),
                 [](const Worst& one) { return *one.inspection; });
  return inspections;
}

}  // namespace rastercheck::properties
