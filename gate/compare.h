#pragma once

// Compares two baseline sections. The comparison is exact, without tolerance: both sections have
// the same cases and drawing is deterministic, so equal drawings have figures equal to the bit.

#include <string>
#include <vector>

#include "cases/error.h"
#include "records/baseline.h"
#include "records/comparison.h"

namespace rastercheck::gate {

struct CompareOptions {
  std::size_t most_growths = 20;
};

/// Fails if the figures are not comparable: different version of records or rules, different seed,
/// cases or options, or different cases of a law that both have. The reason names the difference.
Result<records::Comparison> compare(const records::BaselineSection& before,
                                    const records::BaselineSection& after,
                                    const CompareOptions& options = {});

/// The names of both files, for errors.
struct CompareFiles {
  std::string baseline;
  std::string current;
};
/// Compares each section of `current` with its counterpart in `baseline` (find_section). Also fails
/// if a counterpart is missing.
Result<std::vector<records::Comparison>> compare(const records::Baseline& baseline,
                                                 const records::Baseline& current,
                                                 const CompareFiles& files,
                                                 const CompareOptions& options = {});

/// find_section(), or an error that lists the existing sections; `file` names the baseline in the
/// error.
Result<const records::BaselineSection*> section_for(const records::Baseline& baseline,
                                                    const records::BaselineSection& current,
                                                    const std::string& file);

/// Fails if versions of records or rules differ; the reason names the difference.
Result<void> check_versions(const records::BaselineSection& before,
                            const records::BaselineSection& after);

}  // namespace rastercheck::gate
