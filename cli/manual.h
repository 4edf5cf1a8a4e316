#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace rastercheck::cli {

/// The manual page rastercheck(1), for `man`: every command with its arguments and options, worded
/// as in --help. In roff, UTF-8.
std::string manual_page(const CLI::App& program);

}  // namespace rastercheck::cli
