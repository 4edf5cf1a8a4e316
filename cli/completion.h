#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace rastercheck::cli {

/// Returns a bash script that completes the program's commands and options, and values of the types
/// in command.h. The script asks the program for backends and properties once per shell.
std::string bash_completion(const CLI::App& program);

}  // namespace rastercheck::cli
