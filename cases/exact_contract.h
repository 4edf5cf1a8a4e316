#pragma once

#include "cases/contract.h"

namespace rastercheck::cases {

/// The same contract of exact triangles: nothing is snapped or left open, and values are as the
/// rules interpolate. The tie rule stays.
inline Contract exact_contract(Contract contract) {
  contract.coverage.reset();
  contract.basis = Basis::ideal;
  contract.claims = Claim::perspective;
  return contract;
}

}  // namespace rastercheck::cases
