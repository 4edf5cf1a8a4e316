#pragma once

// Accepts current figures into a baseline, with a reason.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cases/error.h"
#include "gate/compare.h"
#include "gate/sections.h"

namespace rastercheck::gate {

/// Selects the entries to accept by shell patterns, as in fnmatch(3).
struct EntryPattern {
  std::string law = "*";
  std::string kind = "*";
  /// The name of a records::Stratum. "all" matches every entry: the entry of all strata together
  /// (EntryKey without a stratum) and those of single strata, because the error of a case counts in
  /// both.
  std::string stratum = "*";
  bool operator==(const EntryPattern&) const = default;
  bool matches(const records::EntryKey& key) const;
  /// True if the pattern matches every entry.
  bool is_all() const { return law == "*" && kind == "*" && (stratum == "*" || stratum == "all"); }
};

/// Returns the number of violated cases per law after acceptance, for each law in which more or
/// other cases are violated than before.
std::map<std::string, std::uint64_t> violations_taken(const records::Comparison& comparison,
                                                      const EntryPattern& pattern);

/// Accepts the changes from `current`, the section that `comparison` compared with `section`. If
/// the pattern matches all entries, accepts all their cases as well; otherwise accepts only the
/// errors and counts of cases that belong to the matched entries. Adds the approval and returns one
/// line per change; does nothing and returns no lines if nothing changed.
std::vector<std::string> approve(records::BaselineSection& section,
                                 const records::BaselineSection& current,
                                 const records::Comparison& comparison, const EntryPattern& pattern,
                                 const std::string& reason);

}  // namespace rastercheck::gate
