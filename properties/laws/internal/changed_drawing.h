#pragma once

// What laws have in common that draw a case changed so that its truth stays, and hold what is drawn
// against what is drawn of the case as it was.

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Holds `drawn`, of a changed case, against `before`, which is drawn of `c`: in the same places,
/// and with the same values, to the bit, or else right for `c` under the contract. What is alike is
/// as right as it was, which other laws ask; so the oracle is asked only where the two differ. Of
/// values that differ, as the last bit may where values are rounded, some are judged, evenly spread
/// over them. Derivatives are not looked at. Labels: those of the state, "snapped", and "tie",
/// "permitted" and other reasons of samples where places differ.
Check judge_changed(const cases::Case& c, const cases::Contract& contract,
                    const cases::Fragments& before, const cases::Fragments& drawn,
                    std::uint64_t index);

}  // namespace rastercheck::properties
