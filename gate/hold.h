#pragma once

// The whole of a comparison, as `rastercheck compare` and `rastercheck run --baseline` make it.

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
  std::string folder;  ///< for what reports/compare_format.h lists; empty: none
  std::string corpus;  ///< folder of the corpus, of comparisons whose options name none
  /// What starts a process that draws with a foreign backend (backends::Isolation).
  std::vector<std::string> worker;
  double timeout = records::kDefaultTimeout;  ///< seconds that such a process has for a draw
};

/// Holds one side against the other. Where there is a folder, draws again and looks at what came
/// out otherwise. What is given refers to both sides, which have to outlive it.
Result<reports::Gate> hold(const Side& baseline, const Side& current, const HoldOptions& options);

/// Writes the comparison's files into its folder, the cases that grew among them.
Result<void> write_files(const reports::Gate& gate, const std::string& corpus);

}  // namespace rastercheck::gate
