#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace rastercheck::cli {

/// The option `--format LIST` of commands that write reports.
void add_formats(CLI::App& app, std::vector<std::string>& formats);

}  // namespace rastercheck::cli
