#pragma once

// What rasterizers draw for the accuracy table (records/accuracy.h).

#include <cstdint>
#include <vector>

#include "cases/case.h"

namespace rastercheck::properties {

/// Random cases under OpenGL's rules, with one sample or four, named accuracy-0001 and so on. No
/// feature of theirs is essential: what a backend lacks is left out of a case (fitted_case.h).
std::vector<cases::Case> accuracy_cases(std::uint64_t seed, std::uint64_t count);

}  // namespace rastercheck::properties
