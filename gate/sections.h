#pragma once

// Sections of baselines (records/baseline.h): made from runs, found and put into place.

#include <string>
#include <vector>

#include "cases/error.h"
#include "records/baseline.h"
#include "records/run.h"

namespace rastercheck::gate {

/// The section of one of a run's backends, under its own name, of any instruction set and compiler.
/// Fails where the run did not keep its cases, was interrupted, or is not of that backend. No
/// commit is known of it.
Result<records::BaselineSection> section_of(const records::Run& run, const std::string& backend);

/// All of them, in the order of their keys. Fails also where two are one by their names.
Result<records::Baseline> baseline_of(const records::Run& run);

/// The section that `current` is to be held against: of the same backend and architecture, and of
/// what current.taken says of instruction set and compiler or of any. Of several the most specific;
/// the instruction set says more than the compiler. nullptr where there is none.
const records::BaselineSection* find_section(const records::Baseline& baseline,
                                             const records::BaselineSection& current);

}  // namespace rastercheck::gate
