#pragma once

// Makes sections of baselines (records/baseline.h) from runs, and finds them.

#include <string>
#include <vector>

#include "cases/error.h"
#include "records/baseline.h"
#include "records/run.h"

namespace rastercheck::gate {

/// Makes the section of one backend of a run. The key has the backend's own name and leaves
/// instruction set and compiler unspecified; the commit stays empty. Fails if the run did not keep
/// its cases, was interrupted, or lacks that backend.
Result<records::BaselineSection> section_of(const records::Run& run, const std::string& backend);

/// Makes the sections of all backends, in key order. Also fails if two backends have the same
/// section name.
Result<records::Baseline> baseline_of(const records::Run& run);

/// Adds the results of a run of other cases to a section, as if one run had checked them all.
/// Leaves plan and specimens as they are. Fails as section_of() does.
Result<void> add_cases(records::BaselineSection& section, const records::Run& run,
                       const std::string& backend);

/// Finds the section to compare `current` with: same backend and architecture, and instruction set
/// and compiler either as in current.taken or unspecified. Returns the most specific one, where the
/// instruction set counts more than the compiler; nullptr if none matches.
const records::BaselineSection* find_section(const records::Baseline& baseline,
                                             const records::BaselineSection& current);

}  // namespace rastercheck::gate
