#pragma once

// Taking current figures over into a baseline, with the reason.

#include <string>
#include <vector>

#include "cases/error.h"
#include "reports/baseline.h"
#include "reports/compare.h"

namespace rastercheck::reports {

/// What is taken over: entries that match, by patterns as a policy has them (policy.h).
struct EntryPattern {
  std::string law = "*";
  std::string kind = "*";
  std::string stratum = "*";  ///< "all" is that of all strata together
  bool operator==(const EntryPattern&) const = default;
  bool matches(const EntryKey& key) const;
  bool is_all() const { return *this == EntryPattern(); }
};

/// Takes what changed over from `current`, the section that `comparison` held against `section`.
/// Of all entries, all of its cases as well; of some, the errors and counts of cases that these
/// are of. Adds the approval, and gives what changed, a line each: empty, and nothing is done,
/// where there is nothing to take over.
std::vector<std::string> approve(BaselineSection& section, const BaselineSection& current,
                                 const Comparison& comparison, const EntryPattern& pattern,
                                 const std::string& reason);

}  // namespace rastercheck::reports
