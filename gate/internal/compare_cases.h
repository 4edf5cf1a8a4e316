#pragma once

// Cases of two sections, one by one.

#include <cstdint>
#include <map>

#include "gate/compare.h"
#include "gate/sections.h"
#include "records/enclosure.h"

namespace rastercheck::gate {

/// Whether one magnitude is larger than the other. Enclosures of errors are as narrow as doubles
/// get and depend on the fragment alone, so that of two, the larger pair of ends, the far one
/// first, is of the larger error or of one that doubles do not tell from it (as records/record.cpp
/// has it): equal errors never count as grown.
bool is_larger(const records::Enclosure& a, const records::Enclosure& b);

/// Of each entry how many cases grew (Figure::grown_cases); only of those where some did.
std::map<records::EntryKey, std::uint64_t> grown_cases(const records::BaselineSection& before,
                                                       const records::BaselineSection& after);

/// Fills in growths and the numbers of cases.
void compare_cases(const records::BaselineSection& before, const records::BaselineSection& after,
                   const CompareOptions& options, records::Comparison& comparison);

}  // namespace rastercheck::gate
