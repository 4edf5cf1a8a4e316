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

/// Seconds that a foreign backend may take to answer, by default.
using records::kDefaultTimeout;

/// Adds the option `--timeout` to a command that draws.
void add_timeout(CLI::App& app, double& seconds);

/// Adds the option `--draw-by` to a command that draws; `way` stays empty without the option. The
/// caller must set the description.
CLI::Option* add_draw_by(CLI::App& app, std::optional<cases::DrawBy>& way,
                         std::span<const std::string_view> names);

/// Returns the command by which this program draws with a foreign backend (backends/isolation.h).
std::vector<std::string> worker_program();

/// Returns a factory that makes foreign backends in separate processes, and holds all backends to
/// `terms`, if given.
backends::BackendFactory backend_factory(double timeout,
                                         std::optional<cases::ContractTerms> terms = std::nullopt);

}  // namespace rastercheck::cli
