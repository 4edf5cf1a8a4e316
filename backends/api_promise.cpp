#include "backends/api_promise.h"

namespace rastercheck::backends {

cases::Contract api_promise(const cases::Case& c, const ApiLimits& limits) {
  cases::Contract contract = cases::contract_of(c);
  contract.coverage =
      cases::Snapping{limits.subpixel_bits, cases::Rounding::unspecified, /*position_error=*/0};
  contract.basis = cases::Basis::unspecified;
  contract.tie_rule = cases::TieRule::unspecified;
  contract.is_on_grid = false;
  return contract;
}

}  // namespace rastercheck::backends
