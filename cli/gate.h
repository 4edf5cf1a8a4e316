#pragma once

// A comparison as `rastercheck compare` and `rastercheck run --baseline` show it.

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
  std::string output;  ///< folder for what compare_format.h lists; empty: none
  bool json = false;   ///< prints compare.json instead of text
  bool quiet = false;
  bool prints = true;
  double timeout = kDefaultTimeout;  ///< seconds, of foreign backends that draw once more
};

/// The policy of a file; of none, which has no name, one that allows nothing.
Result<gate::Policy> read_policy(const std::string& file);

/// Refuses a folder (GateOptions::output) where a file of the comparison would be written over one
/// of the files that it is made from.
Result<void> check_comparison_files(const std::string& folder, std::span<const std::string> inputs);

/// Compares, writes and prints, and tells GitHub; `regression` where an entry is worse that the
/// policy does not allow.
ExitCode hold_against(const gate::Side& baseline, const gate::Side& current,
                      const GateOptions& options);

/// Which of two outcomes a command ends with (CONTRACT, exit codes).
ExitCode first_of(ExitCode a, ExitCode b);

}  // namespace rastercheck::cli
