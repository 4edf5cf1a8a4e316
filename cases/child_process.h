#pragma once

// A child process that is asked one thing.

#include <cstdint>
#include <string>
#include <vector>

#include "cases/error.h"

namespace rastercheck::cases {

/// What became of a child process.
struct ChildOutcome {
  std::string output;    ///< on standard output
  bool is_whole = true;  ///< false where it said more than it may, and was ended
  int signal = 0;        ///< that ended it, 0 where none did
  int exit_code = 0;
};

/// Runs a command (program and arguments) to its end with this process's standard input; what it
/// says on standard error is dropped. It may say `most_output` bytes. Fails where it cannot be
/// started.
Result<ChildOutcome> run_child(const std::vector<std::string>& command, std::uint64_t most_output);

/// What a process may use from now on.
struct ProcessLimits {
  std::uint64_t memory = 0;  ///< bytes beyond those that it has
  unsigned seconds = 0;      ///< of processor time; SIGXCPU ends it then
  bool operator==(const ProcessLimits&) const = default;
};

/// Limits this process, which also writes neither files nor core dumps from now on.
Result<void> limit_this_process(const ProcessLimits& limits);

}  // namespace rastercheck::cases
