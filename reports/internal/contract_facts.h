#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::reports {

/// Returns the promises that matter for a case, for readers: pairs of a term and its description.
std::vector<std::pair<std::string, std::string>> contract_facts(const cases::Contract& contract,
                                                                const cases::Case& source);

}  // namespace rastercheck::reports
