#pragma once

// The commands and their options, as --help, the manual and the completion of shells tell them:
// they are declared once, where CLI11 parses them.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace rastercheck::cli {

/// An option or argument in words, as people read of it.
struct OptionText {
  std::string names;        ///< "-q, --quiet"
  std::string value;        ///< "DIR"; empty of a flag, and of an argument
  std::string description;  ///< with choices, range and default
};

/// Those that are for users.
std::vector<const CLI::App*> shown_commands(const CLI::App& app);
std::vector<const CLI::Option*> arguments_of(const CLI::App& app);
std::vector<const CLI::Option*> options_of(const CLI::App& app);

OptionText text_of(const CLI::Option& option);
/// The kind of value: kFile (command.h), say. Empty of a flag.
std::string type_of(const CLI::Option& option);
/// All values that it takes, where it takes these alone; else none.
std::vector<std::string> choices_of(const CLI::Option& option);

/// "rastercheck corpus add".
std::string full_name(const CLI::App& app);
/// "rastercheck corpus add [OPTIONS] FILE", or with COMMAND at its end.
std::string usage_of(const CLI::App& app);

}  // namespace rastercheck::cli
