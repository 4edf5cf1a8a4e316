#pragma once

#include <CLI/CLI.hpp>

#include "cases/error.h"

namespace rastercheck::cli {

/// Why a command line was refused, and what to do: a name that there is and that was perhaps meant,
/// and whose --help to read.
Error wrong_usage(const CLI::App& program, const CLI::ParseError& refusal);

}  // namespace rastercheck::cli
