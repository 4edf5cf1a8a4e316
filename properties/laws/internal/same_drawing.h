#pragma once

// What laws have in common that hold one drawing to be another one, bit for bit.

#include <string>

#include "cases/case.h"
#include "cases/fragments.h"
#include "properties/law.h"

namespace rastercheck::properties {

/// Holds `drawn` to have the fragments of `expected`, each once, with the same depths, attributes
/// and derivatives to the bit, in any order; NaNs are alike. Both are of case `c`, whose state
/// gives the labels. Violations end with `note`, which says how `drawn` came about.
Check compare_drawings(const cases::Case& c, const cases::Fragments& expected,
                       const cases::Fragments& drawn, const std::string& note);

}  // namespace rastercheck::properties
