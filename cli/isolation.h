#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "cases/contract_terms.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// Seconds that a foreign backend may take to answer.
using records::kDefaultTimeout;

/// The option `--timeout` of commands that draw.
void add_timeout(CLI::App& app, double& seconds);

/// This program and the arguments that make it draw with a foreign backend (backends/isolation.h).
std::vector<std::string> worker_program();

/// Makes backends, foreign ones in such processes, all held to these terms, if there are any.
backends::BackendFactory backend_factory(double timeout,
                                         std::optional<cases::ContractTerms> terms = std::nullopt);

}  // namespace rastercheck::cli
