#pragma once

// The commands of `rastercheck`. A file in cli/commands/ defines one and registers it:
//
//   const Registration kRegistration("name", "Says what it does, as --help has it", &set_up);
//
// docs/adding-a-command.md walks through it.

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string>

#include "cases/error.h"
#include "cli/exit_code.h"

namespace rastercheck::cli {

// The type_name() values of options and arguments that shells can complete; other types get no
// completion.
inline constexpr const char* kBackend = "BACKEND";
inline constexpr const char* kProperty = "PROPERTY";
inline constexpr const char* kFile = "FILE";
inline constexpr const char* kFolder = "DIR";

/// The work of a command, done after its options are read.
using Action = std::function<ExitCode()>;

struct Command {
  std::string name;
  std::string summary;
  /// Declares the command's options on its subcommand and returns its action.
  std::function<Action(CLI::App&)> set_up;
};

/// All commands, in the order of their names.
std::span<const Command> commands();

struct Registration {
  Registration(std::string name, std::string summary, std::function<Action(CLI::App&)> set_up);
};

/// Prints "rastercheck: file: place: reason" to standard error.
ExitCode fail(const Error& error);
/// Like fail(), for a bug in this program: "rastercheck: internal error: …".
ExitCode fail_internally(const Error& error);

}  // namespace rastercheck::cli
