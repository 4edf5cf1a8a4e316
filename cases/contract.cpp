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
  const auto has_value = [&](std::size_t vertex, std::size_t attribute) {
    // Of flat ones nothing is computed.
    return c.attributes[attribute].interpolation == Interpolation::flat ||
           has(c.attributes_of(vertex)[attribute]);
  };
  for (std::size_t i = 0; i < c.positions.size(); ++i) {
    const ClipVertex& p = c.positions[i];
    if (!has(p.x) || !has(p.y) || !has(p.z) || !has(p.w)) return false;
    for (std::size_t a = 0; a < c.attributes.size(); ++a) {
      if (!has_value(i, a)) return false;
    }
  }
  return std::all_of(c.clip_distances.begin(), c.clip_distances.end(), has) &&
         has(c.viewport.min_depth) && has(c.viewport.max_depth);
}

Contract contract_of(const Case& c) {
  Contract contract;
  contract.coverage = c.coverage;
  contract.basis = c.coverage ? c.basis : Basis::ideal;
  contract.tie_rule = c.fill_rule;
  return contract;
}

}  // namespace rastercheck::cases
