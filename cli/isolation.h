#pragma once

#include <CLI/CLI.hpp>

#include "records/plan.h"

namespace rastercheck::cli {

/// Seconds that a foreign backend may take to answer.
using records::kDefaultTimeout;

/// The option `--timeout` of commands that draw.
void add_timeout(CLI::App& app, double& seconds);

/// From now on foreign backends are made in processes of this program (backends/isolation.h).
void isolate_foreign_backends(double timeout);

}  // namespace rastercheck::cli
