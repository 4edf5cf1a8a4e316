#pragma once

// Commands of others, run to their end: git, and what makes a user's program.

#include <functional>
#include <string>
#include <vector>

#include "cases/child_process.h"
#include "cases/error.h"

namespace rastercheck::gate {

/// How a command is run.
struct OutsideRun {
  /// File that all that it says is added to.
  std::string log;
  /// File that takes what it says on standard output instead; empty: that goes to the log, too.
  std::string output = {};
  cases::ProcessGroup group = cases::ProcessGroup::own;
  /// Called several times a second; once it says so, the command, with all that it started, is
  /// asked to end, and some seconds later made to.
  std::function<bool()> is_to_end = [] { return false; };
};

/// Runs a command in the current folder, without input. Fails where it cannot be started.
Result<cases::ProcessEnd> run_outside(const std::vector<std::string>& command,
                                      const OutsideRun& how);

/// The line of what a command said that tells most of why it failed: the first with an error, else
/// the last that is not empty; fit for a terminal.
std::string telling_line(const std::string& text);

}  // namespace rastercheck::gate
