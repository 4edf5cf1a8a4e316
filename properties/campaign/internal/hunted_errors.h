#pragma once

// The errors of a checked case, as a hunt compares them (properties/campaign/hunt.h).

#include <map>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"
#include "properties/campaign/hunt.h"
#include "records/judgement.h"

namespace rastercheck::properties {

/// The errors worth comparing of one judged drawing of a case: the worst error of each kind and
/// stratum, and of each kind the worst excess. Each is judged again, alone, which gives the members
/// that the judgement of the drawing does not have, and shows whether the value belongs to this
/// case: some laws also judge changed versions of a case. `not_of_case` counts the others.
struct HuntedErrors {
  std::vector<HuntedError> all;
  std::uint64_t not_of_case = 0;
};

/// `c` may have a camera. `contract` is the one that the drawing was judged by. Returns none if
/// clip positions are beyond float32.
HuntedErrors hunted_errors(const cases::Case& c, const cases::Contract& contract,
                           const std::map<records::AttributeKind, records::ErrorStatistics>& found);

}  // namespace rastercheck::properties
