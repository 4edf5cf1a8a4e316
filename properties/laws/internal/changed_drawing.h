#pragma once

// For laws that change a case without changing its exact truth, draw it, and compare the drawing
// with one of the unchanged case.

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Compares `drawn`, a drawing of a changed case, with `before`, a drawing of `c`. Fragments must
/// be in the same places with bitwise the same values, or else be right for `c` under the contract.
///
/// Equal fragments are as right as in `before`, which other laws check, so the oracle judges only
/// differences. Values may differ by rounding; an evenly spread selection of the fragments that
/// differ is judged. Derivatives are ignored. The labels are those of the state, "snapped" and, if
/// places differ, "tie", "permitted" and the other reasons of samples.
Check judge_changed(const cases::Case& c, const cases::Contract& contract,
                    const cases::Fragments& before, const cases::Fragments& drawn,
                    std::uint64_t index);

}  // namespace rastercheck::properties
