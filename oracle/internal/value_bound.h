#pragma once

#include <cstddef>
#include <optional>

#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::oracle {

/// What the contract promises of an attribute, or of the depth where there is none; 0 of flat ones.
cases::ValueBound bound_of(const cases::Contract& contract, const cases::Case& source,
                           std::optional<std::size_t> attribute);

}  // namespace rastercheck::oracle
