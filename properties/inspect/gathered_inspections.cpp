#include "properties/inspect/gathered_inspections.h"

#include <algorithm>
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

}  // namespace

GatheredInspections::GatheredInspections(const records::Run& run)
    : run_(&run), of_counterexamples_(run.counterexamples.size()) {}

void GatheredInspections::add(const records::Run& shard) {
  for (const Inspection& inspection : shard.inspections) {
    if (inspection.occasion == Occasion::counterexample) add_counterexample(shard, inspection);
    if (inspection.occasion == Occasion::worst) add_worst(inspection);
  }
}

void GatheredInspections::add_counterexample(const records::Run& shard,
                                             const Inspection& inspection) {
  if (inspection.counterexample >= shard.counterexamples.size()) return;
  const auto& all = run_->counterexamples;
  const auto place =
      std::find(all.begin(), all.end(), shard.counterexamples[inspection.counterexample]);
  if (place == all.end()) return;
  const auto i = static_cast<std::size_t>(place - all.begin());
  if (of_counterexamples_[i]) return;
  of_counterexamples_[i] = inspection;
  of_counterexamples_[i]->counterexample = i;
}

void GatheredInspections::add_worst(const Inspection& inspection) {
  const std::optional<double> size = size_of(inspection);
  if (!size || !inspection.kind || !inspection.stratum) return;
  Worst one{*size, inspection};
  const Key key(inspection.backend, *inspection.kind, *inspection.stratum);
  const auto [kept, is_new] = largest_.try_emplace(key, one);
  if (!is_new && is_preferred(one, kept->second)) kept->second = std::move(one);
}

/// Orders errors as inspect_run() prefers them.
bool GatheredInspections::is_preferred(const Worst& a, const Worst& b) {
  const auto rank = [](const Worst& one) {
    const Inspection& inspection = one.inspection;
    return std::tuple(-one.size, inspection.law != kValuesLaw, inspection.law);
  };
  return rank(a) < rank(b);
}

std::vector<Inspection> GatheredInspections::finish() && {
  std::vector<Inspection> inspections;
  for (std::optional<Inspection>& one : of_counterexamples_) {
    if (inspections.size() == records::kMostInspections) return inspections;
    if (one) inspections.push_back(*std::move(one));
  }
  std::vector<Worst> worst;
  worst.reserve(largest_.size());
  for (auto& [key, one] : largest_) worst.push_back(std::move(one));
  std::stable_sort(worst.begin(), worst.end(),
                   [](const Worst& a, const Worst& b) { return a.size > b.size; });
  worst.resize(std::min(worst.size(), records::kMostInspections - inspections.size()));
  const auto key = [](const Worst& one) {
    const Inspection& inspection = one.inspection;
    return std::tie(inspection.law, inspection.backend, inspection.kind, inspection.stratum);
  };
  std::sort(worst.begin(), worst.end(),
            [key](const Worst& a, const Worst& b) { return key(a) < key(b); });
  for (Worst& one : worst) inspections.push_back(std::move(one.inspection));
  return inspections;
}

}  // namespace rastercheck::properties
