#pragma once

// Explains why a counterexample fails, by experiment: which parts of its drawings must be corrected
// for the law to hold, and which features of the case the failure needs.
//
// A shrunk case is so small that almost any change makes the law hold by chance. So each feature is
// removed from several cases: the shrunk case, the same case with more of its triangle in the
// framebuffer, and the original case. A feature is needed if the law then holds for every case to
// which it applies.

#include <optional>

#include "backends/backend.h"
#include "cases/case.h"
#include "properties/campaign/known_defects.h"
#include "properties/campaign/shrink.h"
#include "properties/law.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// Explains a shrunk counterexample, whose `found` must be set; ignores known defects. Empty if the
/// backend fails in another way or is lost. Also empty if `is_to_end` returns true before the end,
/// as an incomplete explanation would be wrong.
std::optional<records::Explanation> explain(const Law& law, backends::Backend& backend,
                                            const records::Counterexample& shrunk,
                                            const cases::Case& found_at_first,
                                            const KnownDefects* known, const IsToEnd& is_to_end);

}  // namespace rastercheck::properties
