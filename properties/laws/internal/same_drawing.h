#pragma once

// For laws that expect one drawing to equal another bit for bit.

#include <string>

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Checks that `drawn` has the fragments of `expected`, each once, in any order, with the same
/// depths, attributes and derivatives to the bit; any two NaNs are the same. Both are drawings of
/// `c`, whose state gives the labels. Violations end with `note`, which says how `drawn` was made.
Check compare_drawings(const cases::Case& c, const cases::Fragments& expected,
                       const cases::Fragments& drawn, const std::string& note);

}  // namespace rastercheck::properties
