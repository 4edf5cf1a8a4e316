#pragma once

#include <CLI/CLI.hpp>

#include "cases/error.h"

namespace rastercheck::cli {

/// Says why a command line was refused, and what to do: suggests an existing name that may have
/// been meant, and names the command whose --help to read.
Error wrong_usage(const CLI::App& program, const CLI::ParseError& refusal);

}  // namespace rastercheck::cli
