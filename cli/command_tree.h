#pragma once

// The commands and their options, for --help, the manual and shell completion. They are declared
// once, where CLI11 parses them.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace rastercheck::cli {

/// The text that describes an option or argument.
struct OptionText {
  std::string names;        ///< "-q, --quiet"
  std::string value;        ///< "DIR"; empty for a flag and for an argument
  std::string description;  ///< with choices, range and default
};

/// The commands, arguments and options meant for users.
std::vector<const CLI::App*> shown_commands(const CLI::App& app);
std::vector<const CLI::Option*> arguments_of(const CLI::App& app);
std::vector<const CLI::Option*> options_of(const CLI::App& app);

OptionText text_of(const CLI::Option& option);
/// Returns the kind of value, such as kFile (command.h); empty for a flag.
std::string type_of(const CLI::Option& option);
/// Returns all values that the option accepts if they are a fixed set; otherwise empty.
std::vector<std::string> choices_of(const CLI::Option& option);

/// Returns the full name: "rastercheck corpus add".
std::string full_name(const CLI::App& app);
/// Returns the usage: "rastercheck corpus add [OPTIONS] FILE", or with COMMAND at its end.
std::string usage_of(const CLI::App& app);

}  // namespace rastercheck::cli
