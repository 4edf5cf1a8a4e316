#pragma once

// A complete comparison, as made by `rastercheck compare` and `rastercheck run --baseline`.

#include <string>
#include <vector>

#include "cases/error.h"
#include "gate/policy.h"
#include "gate/side.h"
#include "records/plan.h"
#include "reports/compare_format.h"

namespace rastercheck::gate {

struct HoldOptions {
  Policy policy;       ///< applied as of today
  std::string folder;  ///< for the files listed in reports/compare_format.h; empty: none
  std::string corpus;  ///< folder of the corpus if a comparison's options name none
  /// The command that starts a process to draw with a foreign backend (backends::Isolation).
  std::vector<std::string> worker;
  double timeout = records::kDefaultTimeout;  ///< limit for one drawing by that process, seconds
};

/// Compares one side with the other. If a folder is given, also draws differing cases again and
/// inspects them. The result refers to both sides, which must outlive it.
Result<reports::Gate> hold(const Side& baseline, const Side& current, const HoldOptions& options);

/// Writes the comparison's files into its folder, including grown cases.
Result<void> write_files(const reports::Gate& gate, const std::string& corpus);

}  // namespace rastercheck::gate
