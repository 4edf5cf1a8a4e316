#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace rastercheck::cli {

/// Returns the formatter of --help, which fits texts of any length into the 80 columns of a
/// terminal. Footer lines that begin with a space stay unchanged.
std::shared_ptr<CLI::FormatterBase> help_format();

}  // namespace rastercheck::cli
