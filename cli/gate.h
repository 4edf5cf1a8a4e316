#pragma once

// Shows a comparison, for `rastercheck compare` and `rastercheck run --baseline`.

#include <span>
#include <string>

#include "cases/error.h"
#include "cli/exit_code.h"
#include "cli/isolation.h"
#include "gate/policy.h"
#include "gate/side.h"

namespace rastercheck::cli {

struct GateOptions {
  gate::Policy policy;
  std::string output;  ///< folder for the files of compare_format.h; empty: none
  bool json = false;   ///< prints compare.json instead of text
  bool quiet = false;
  bool prints = true;
  double timeout = kDefaultTimeout;  ///< seconds, for foreign backends that draw again
};

/// Reads a policy from a file; without a file name, returns a policy that allows nothing.
Result<gate::Policy> read_policy(const std::string& file);

/// Refuses a folder (GateOptions::output) if writing the comparison would overwrite one of its
/// inputs.
Result<void> check_comparison_files(const std::string& folder, std::span<const std::string> inputs);

/// Compares, writes, prints and tells GitHub. Returns `regression` if an entry is worse and the
/// policy does not allow it.
ExitCode hold_against(const gate::Side& baseline, const gate::Side& current,
                      const GateOptions& options);

/// Returns the outcome that takes precedence as a command's exit code (docs/commands.md).
ExitCode first_of(ExitCode a, ExitCode b);

}  // namespace rastercheck::cli
