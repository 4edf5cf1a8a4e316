#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace rastercheck::cli {

/// Adds the option `--format LIST` to a command that writes reports.
void add_formats(CLI::App& app, std::vector<std::string>& formats);

}  // namespace rastercheck::cli
