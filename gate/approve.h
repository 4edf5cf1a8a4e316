#pragma once

// Taking current figures over into a baseline, with the reason.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cases/error.h"
#include "gate/compare.h"
#include "gate/sections.h"

namespace rastercheck::gate {

/// What is taken over: entries that match, by patterns of shells, as fnmatch(3) has them.
struct EntryPattern {
  std::string law = "*";
  std::string kind = "*";
  /// "all" is the entry of all strata together and those of each: what grew in a case is of both.
  std::string stratum = "*";
  bool operator==(const EntryPattern&) const = default;
  bool matches(const records::EntryKey& key) const;
  /// Whether it matches any entry.
  bool is_all() const { return law == "*" && kind == "*" && (stratum == "*" || stratum == "all"); }
};

/// Of each law how many cases are violated once that is taken over: of laws of which more are, or
/// others.
std::map<std::string, std::uint64_t> violations_taken(const records::Comparison& comparison,
                                                      const EntryPattern& pattern);

/// Takes what changed over from `current`, the section that `comparison` held against `section`.
/// Of all entries, all of its cases as well; of some, the errors and counts of cases that these
/// are of. Adds the approval, and gives what changed, a line each: empty, and nothing is done,
/// where there is nothing to take over.
std::vector<std::string> approve(records::BaselineSection& section,
                                 const records::BaselineSection& current,
                                 const records::Comparison& comparison, const EntryPattern& pattern,
                                 const std::string& reason);

}  // namespace rastercheck::gate
