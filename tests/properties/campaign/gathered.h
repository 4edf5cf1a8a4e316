#pragma once

#include <functional>
#include <utility>

#include "properties/campaign/workers.h"

namespace rastercheck::properties {

/// The merged findings of all tasks, however they are run; ends at the first fault.
inline Result<Findings> gathered(const std::function<Result<void>(const TaskDone&)>& run) {
  Findings findings;
  const Result<void> done = run([&findings](std::size_t /*task*/, Findings found) {
    merge(findings, std::move(found));
    return !findings.fault;
  });
  if (!done) return tl::unexpected(done.error());
  return findings;
}

}  // namespace rastercheck::properties
