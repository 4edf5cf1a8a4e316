#pragma once

// Runs external commands to their end: git, and the user's build.

#include <functional>
#include <string>
#include <vector>

#include "cases/child_process.h"
#include "cases/error.h"

namespace rastercheck::gate {

/// How a command is run.
struct OutsideRun {
  /// File to which all output is appended.
  std::string log;
  /// File for standard output instead; empty: the log as well.
  std::string output = {};
  cases::ProcessGroup group = cases::ProcessGroup::own;
  /// Called several times a second. Once it returns true, the command and all its children are
  /// asked to end, and killed some seconds later.
  std::function<bool()> is_to_end = [] { return false; };
};

/// Runs a command in the current folder, without input. Fails if it cannot be started.
Result<cases::ProcessEnd> run_outside(const std::vector<std::string>& command,
                                      const OutsideRun& how);

/// Returns the most telling line of a failed command's output: the first with an error, else the
/// last that is not empty; safe for a terminal.
std::string telling_line(const std::string& text);

}  // namespace rastercheck::gate
