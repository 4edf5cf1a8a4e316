#include "properties/campaign/frozen_case.h"

#include "properties/fitted_case.h"
#include "properties/law.h"

namespace rastercheck::properties {

std::optional<cases::Case> frozen_case(const records::CaseKey& key, const records::Plan& plan,
                                       std::span<const cases::Case> corpus) {
  if (key.origin == records::Origin::corpus) {
    if (key.index >= corpus.size()) return std::nullopt;
    return fitted_case(records::capabilities_of(plan, key.backend), corpus[key.index]);
  }
  const Law* law = key.origin == records::Origin::random ? find_law(key.law) : nullptr;
  if (law == nullptr || law->generate == nullptr) return std::nullopt;
  return random_case(*law, plan.seed, key.index, records::capabilities_of(plan, key.backend))
      .source;
}

}  // namespace rastercheck::properties
