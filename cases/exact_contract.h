#pragma once

#include "cases/contract.h"

namespace rastercheck::cases {

/// The contract with exact triangles: nothing is snapped or left open, and values interpolate as
/// the rules say. Keeps the tie rule.
inline Contract exact_contract(Contract contract) {
  contract.coverage.reset();
  contract.basis = Basis::ideal;
  contract.claims = Claim::perspective;
  BiasPromise& bias = contract.depth_bias;
  bias.slope = BiasSlope::greatest;
  bias.exponent = BiasExponent::vertices;
  if (bias.unit == BiasUnit::either_power || bias.unit == BiasUnit::open) {
    bias.unit = BiasUnit::power;
  }
  return contract;
}

}  // namespace rastercheck::cases
