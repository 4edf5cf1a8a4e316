#pragma once

// An entry of what is known, made from counterexamples by trying, so that nobody has to write one
// by hand: as narrow as the conditions that the failures were found to need.

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
  std::string sentence;       ///< what is wrong, as causes say it
};

/// The entry that all these counterexamples of a backend, whose `found` names their laws, are of
/// and nothing else as far as trying tells: of what is drawn, where putting that right makes their
/// laws hold; else of their laws. Fails where one fails no more, is known already, or they are of
/// several causes. Errors name a counterexample by its name in `names`, one for each.
Result<Waiver> make_waiver(std::span<const cases::Case> counterexamples,
                           std::span<const std::string> names, backends::Backend& backend,
                           const KnownDefects& known);

}  // namespace rastercheck::properties
