#pragma once

// Why a counterexample fails, found out by trying: what of its drawings has to be put right for the
// law to hold, and what may not be taken away from the case, or the law holds.
//
// A shrunk case is so small that almost any change of it makes the law hold by chance. So what is
// taken away is taken from several cases: the shrunk one, the same with more of its triangle in the
// target, and the one that was found at first. It is needed if the law holds of all that it says
// something of; if it fails of one, it is not.

#include <optional>

#include "backends/backend.h"
#include "cases/case.h"
#include "properties/campaign/known_defects.h"
#include "properties/campaign/shrink.h"
#include "properties/law.h"
#include "records/counterexample.h"

namespace rastercheck::properties {

/// Explains the counterexample that a case was shrunk to, which says how it was found. What is
/// known is left aside. Nothing where the law does not fail again, the backend is lost, or
/// `is_to_end` says so before all is tried: half an explanation would be a wrong one.
std::optional<records::Explanation> explain(const Law& law, backends::Backend& backend,
                                            const records::Counterexample& shrunk,
                                            const cases::Case& found_at_first,
                                            const KnownDefects* known, const IsToEnd& is_to_end);

}  // namespace rastercheck::properties
