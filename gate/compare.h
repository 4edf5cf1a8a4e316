#pragma once

// One section of a baseline held against another. The comparison is exact, and has no tolerance:
// cases are frozen and drawing is deterministic, so that equal drawings have equal figures to the
// bit.

#include <string>
#include <vector>

#include "cases/error.h"
#include "records/baseline.h"
#include "records/comparison.h"

namespace rastercheck::gate {

struct CompareOptions {
  std::size_t most_growths = 20;
};

/// Fails where figures of the two cannot be compared: another version of records or rules, other
/// seed, cases or options, or other cases of a law that both have. The reason names the difference.
Result<records::Comparison> compare(const records::BaselineSection& before,
                                    const records::BaselineSection& after,
                                    const CompareOptions& options = {});

/// Each of `current`'s sections against the one that `baseline` has for it (find_section). Fails
/// where there is none, too. `files` names both in errors.
struct CompareFiles {
  std::string baseline;
  std::string current;
};
Result<std::vector<records::Comparison>> compare(const records::Baseline& baseline,
                                                 const records::Baseline& current,
                                                 const CompareFiles& files,
                                                 const CompareOptions& options = {});

/// find_section(), or an error that names those there are; `file` is the baseline's name in it.
Result<const records::BaselineSection*> section_for(const records::Baseline& baseline,
                                                    const records::BaselineSection& current,
                                                    const std::string& file);

/// Whether both are of the same versions of records and rules; the reason names the difference.
Result<void> check_versions(const records::BaselineSection& before,
                            const records::BaselineSection& after);

}  // namespace rastercheck::gate
