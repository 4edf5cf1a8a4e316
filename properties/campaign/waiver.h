#pragma once

// Makes a known-defect entry from counterexamples by experiment, so that nobody has to write one by
// hand. The entry is as narrow as the conditions that the failures need.

#include <span>
#include <string>

#include "backends/backend.h"
#include "cases/case.h"
#include "cases/error.h"
#include "properties/campaign/known_defects.h"
#include "records/known.h"

namespace rastercheck::properties {

struct Waiver {
  records::KnownEntry entry;  ///< without id, reason, backends, case file and last day
  std::string sentence;       ///< what is wrong, worded as a cause
};

/// Makes an entry that matches all these counterexamples of a backend and, according to
/// experiments, nothing else. The entry is for drawings if correcting the drawings makes the laws
/// (named in `found`) hold; else for their laws. Fails if a counterexample no longer fails or is
/// already known, or if the counterexamples have several causes. Errors refer to counterexamples by
/// `names`, one for each.
Result<Waiver> make_waiver(std::span<const cases::Case> counterexamples,
                           std::span<const std::string> names, backends::Backend& backend,
                           const KnownDefects& known);

}  // namespace rastercheck::properties
