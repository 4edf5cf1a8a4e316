#pragma once

#include <CLI/CLI.hpp>
#include <memory>

namespace rastercheck::cli {

/// How --help looks: within the 80 columns of a terminal, whatever its texts are. A footer's lines
/// that begin with a space are shown as they are.
std::shared_ptr<CLI::FormatterBase> help_format();

}  // namespace rastercheck::cli
