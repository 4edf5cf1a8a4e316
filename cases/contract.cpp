#include "cases/contract.h"

#include "cases/case.h"

namespace rastercheck::cases {

Contract contract_of(const Case& c) {
  Contract contract;
  contract.coverage = c.coverage;
  contract.basis = c.coverage ? c.basis : Basis::ideal;
  contract.tie_rule = c.fill_rule;
  return contract;
}

}  // namespace rastercheck::cases
