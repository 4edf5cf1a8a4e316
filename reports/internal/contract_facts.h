#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cases/case.h"
#include "cases/contract.h"

namespace rastercheck::reports {

/// The promises of a contract that matter for a case, for people: (term, words).
std::vector<std::pair<std::string, std::string>> contract_facts(const cases::Contract& contract,
                                                                const cases::Case& source);

}  // namespace rastercheck::reports
