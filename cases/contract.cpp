#include "cases/contract.h"

#include <algorithm>

#include "cases/case.h"

namespace rastercheck::cases {

bool Contract::is_affine(Interpolation declared) const {
  return declared == Interpolation::noperspective ||
         (declared == Interpolation::smooth && claims == Claim::affine);
}

bool makes_promises_of(const Contract& contract, const Case& c) {
  const auto has = [&contract](float number) { return contract.numbers.has(number); };
  return std::all_of(
             c.positions.begin(), c.positions.end(),
             [&](const ClipVertex& p) { return has(p.x) && has(p.y) && has(p.z) && has(p.w); }) &&
         has(c.viewport.min_depth) && has(c.viewport.max_depth) &&
         std::all_of(c.attribute_values.begin(), c.attribute_values.end(), has) &&
         std::all_of(c.clip_distances.begin(), c.clip_distances.end(), has);
}

Contract contract_of(const Case& c) {
  Contract contract;
  contract.coverage = c.coverage;
  contract.basis = c.coverage ? c.basis : Basis::ideal;
  contract.tie_rule = c.fill_rule;
  return contract;
}

}  // namespace rastercheck::cases
