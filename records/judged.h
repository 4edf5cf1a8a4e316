#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "records/judgement.h"

namespace rastercheck::records {

/// Counts how much was judged.
struct Judged {
  std::uint64_t asked = 0;       ///< requested cases
  std::uint64_t applicable = 0;  ///< cases to which the law applies
  std::uint64_t fragments = 0;   ///< fragments, drawn or missing, whose coverage was judged
  std::uint64_t values = 0;      ///< judged values
  /// Fragments and values drawn but not judged, by reason.
  std::map<std::string, std::uint64_t> not_judged = {};
  bool operator==(const Judged&) const = default;

  /// Fragments and values.
  std::uint64_t all_not_judged() const;
  /// Unjudged fragments and values as a share of all that were drawn or are missing; 0 to 1.
  double share_not_judged() const;
};

void merge(Judged& into, const Judged& from);

/// Adds the fragments, or the values, of one kind.
void add(Judged& judged, AttributeKind kind, const ErrorStatistics& errors);

/// "8,095 not promised, 2,598 without bound"; empty if all was judged.
std::string not_judged_words(const Judged& judged);

}  // namespace rastercheck::records
