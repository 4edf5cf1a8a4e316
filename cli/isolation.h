#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "backends/factory.h"
#include "cases/contract_terms.h"
#include "cases/draw_by.h"
#include "records/plan.h"

namespace rastercheck::cli {

/// Seconds that a foreign backend may take to answer.
using records::kDefaultTimeout;

/// The option `--timeout` of commands that draw.
void add_timeout(CLI::App& app, double& seconds);

/// The option `--draw-by` of commands that draw; nothing without it. It has no description yet.
CLI::Option* add_draw_by(CLI::App& app, std::optional<cases::DrawBy>& way,
                         std::span<const std::string_view> names);

/// This program and the arguments that make it draw with a foreign backend (backends/isolation.h).
std::vector<std::string> worker_program();

/// Makes backends, foreign ones in such processes, all held to these terms, if there are any.
backends::BackendFactory backend_factory(double timeout,
                                         std::optional<cases::ContractTerms> terms = std::nullopt);

}  // namespace rastercheck::cli
