#include "cases/contract.h"

#include "cases/case.h"

namespace rastercheck::cases {

bool Contract::is_affine(Interpolation declared) const {
  return declared == Interpolation::noperspective ||
         (declared == Interpolation::smooth && claims == Claim::affine);
}

Contract contract_of(const Case& c) {
  Contract contract;
  contract.coverage = c.coverage;
  contract.basis = c.coverage ? c.basis : Basis::ideal;
  contract.tie_rule = c.fill_rule;
  return contract;
}

}  // namespace rastercheck::cases
