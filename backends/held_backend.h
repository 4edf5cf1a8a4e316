#pragma once

// A backend held to a contract of someone else's making: what it draws is its own, what it promises
// is what a contract file says (cases/contract_terms.h).

#include <memory>
#include <optional>

#include "backends/backend.h"
#include "cases/contract_terms.h"

namespace rastercheck::backends {

/// The same backend but for what it promises.
std::unique_ptr<Backend> held_to(const cases::ContractTerms& terms,
                                 std::unique_ptr<Backend> backend);

/// The same of one that stays its owner's, and has to outlive it.
std::unique_ptr<Backend> held_to(const cases::ContractTerms& terms, Backend& backend);

/// make_backend() holds what it makes to these terms from now on; of nothing, to its own.
void hold_backends_to(const std::optional<cases::ContractTerms>& terms);

}  // namespace rastercheck::backends
