#include "gate/closer_looks.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "properties/inspect/closer_looks.h"
#include "properties/inspect/specimens.h"

namespace rastercheck::gate {
namespace {

using properties::LookRequest;
using records::Specimen;

/// Maximum numbers of looks in a comparison; each look takes some 40 kB in compare.html.
constexpr std::size_t kMostGrowths = 6;
constexpr std::size_t kMostParts = 4;

std::span<const Specimen> specimens_of(const records::BaselineSection* section) {
  return section == nullptr ? std::span<const Specimen>() : std::span(section->specimens);
}

const records::BaselineSection* section_of_key(const records::Baseline& baseline,
                                               const records::BaselineKey& key) {
  const auto& all = baseline.sections;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&key](const auto& section) { return section.key == key; });
  return found == all.end() ? nullptr : &*found;
}

const records::BaselineSection* section_of_backend(const records::Baseline& baseline,
                                                   const std::string& backend) {
  const auto& all = baseline.sections;
  const auto found = std::find_if(all.begin(), all.end(), [&backend](const auto& section) {
    return section.taken.backend == backend;
  });
  return found == all.end() ? nullptr : &*found;
}

/// Returns a request to look at a grown case at its largest error, with the part that the baseline
/// kept around that error.
LookRequest request_of(const records::CaseGrowth& growth, const std::string& backend,
                       std::span<const Specimen> kept) {
  const records::WorstError& at = *growth.after;
  LookRequest request;
  request.key = {growth.law, backend, growth.origin, growth.index};
  request.case_name = growth.name;
  request.at = at.place;
  request.attribute = at.attribute;
  request.kind = growth.kind;
  request.stratum = growth.stratum;
  request.actual = at.actual;
  const auto around = std::find_if(kept.begin(), kept.end(), [&](const Specimen& one) {
    return one.key.law == growth.law && one.key.origin == growth.origin &&
           one.key.index == growth.index && one.triangle == at.place.triangle &&
           one.index_of(at.place.x, at.place.y, at.place.sample).has_value();
  });
  if (around != kept.end()) request.before = *around;
  return request;
}

/// Removes parts that this program draws with other bits than the current side kept; such drawings
/// cannot be reproduced here.
void leave_out_others(std::vector<Specimen>& again, std::span<const Specimen> after) {
  std::erase_if(again, [&after](const Specimen& one) {
    return std::any_of(after.begin(), after.end(), [&one](const Specimen& kept) {
      return records::is_same_part(one, kept) && records::change_of(one, kept).has_value();
    });
  });
}

std::vector<LookRequest> requests_of(const records::Comparison& comparison,
                                     std::span<const Specimen> kept,
                                     std::span<const Specimen> kept_now,
                                     std::span<const cases::Case> corpus,
                                     properties::CaseDrawer& drawer) {
  std::vector<LookRequest> requests;
  for (const records::CaseGrowth& growth : comparison.growths) {
    if (requests.size() == kMostGrowths) break;
    if (growth.after) requests.push_back(request_of(growth, comparison.backend, kept));
  }
  std::vector<Specimen> again =
      properties::draw_again(kept, comparison.backend, comparison.plan, corpus, drawer);
  leave_out_others(again, kept_now);
  std::vector<LookRequest> parts =
      properties::changed_parts(kept, again, kMostGrowths + kMostParts);
  std::erase_if(parts, [&requests](const LookRequest& part) {
    return std::any_of(requests.begin(), requests.end(),
                       [&part](const LookRequest& growth) { return growth.before == part.before; });
  });
  if (parts.size() > kMostParts) parts.resize(kMostParts);
  std::move(parts.begin(), parts.end(), std::back_inserter(requests));
  return requests;
}

}  // namespace

std::vector<records::CloserLook> look_closer(const records::Comparison& comparison,
                                             const records::Baseline& before,
                                             const records::Baseline& after,
                                             std::span<const cases::Case> corpus,
                                             const backends::BackendFactory& backends) {
  properties::CaseDrawer drawer(backends);
  const std::vector<LookRequest> requests =
      requests_of(comparison, specimens_of(section_of_key(before, comparison.key)),
                  specimens_of(section_of_backend(after, comparison.backend)), corpus, drawer);
  return properties::closer_looks(requests, comparison.plan, corpus, drawer);
}

}  // namespace rastercheck::gate
