#pragma once

// Compares the cases of two sections one by one.

#include <cstdint>
#include <map>

#include "gate/compare.h"
#include "gate/sections.h"
#include "records/enclosure.h"

namespace rastercheck::gate {

/// True if the magnitude of `a` is larger than that of `b`. An error's enclosure is the narrowest
/// pair of doubles around it, and depends on the fragment alone. So the lexicographically larger
/// pair of ends (far end first) belongs to the larger error, unless doubles cannot tell the two
/// errors apart (as in records/record.cpp). Equal errors never count as grown.
bool is_larger(const records::Enclosure& a, const records::Enclosure& b);

/// Returns the number of grown cases per entry (Figure::grown_cases); leaves out entries with none.
std::map<records::EntryKey, std::uint64_t> grown_cases(const records::BaselineSection& before,
                                                       const records::BaselineSection& after);

/// Fills in the comparison's growths and numbers of cases.
void compare_cases(const records::BaselineSection& before, const records::BaselineSection& after,
                   const CompareOptions& options, records::Comparison& comparison);

}  // namespace rastercheck::gate
