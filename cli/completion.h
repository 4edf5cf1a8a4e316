#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace rastercheck::cli {

/// A script for bash that completes the program's commands and options, and values of the types
/// that command_tree.h names. Backends and properties it asks the program for, once in each shell.
std::string bash_completion(const CLI::App& program);

}  // namespace rastercheck::cli
