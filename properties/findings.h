#pragma once

// What parts of a campaign found, and how it comes together: exactly, in whatever order and however
// the work was split.

#include <optional>
#include <string>
#include <vector>

#include "records/counterexample.h"
#include "records/record.h"

namespace rastercheck::properties {

/// What part of a campaign found.
struct Findings {
  records::RecordSet records;
  /// By (law, backend, verdict), one of each: the first by origin and index.
  std::vector<records::Counterexample> counterexamples;
  /// A fault of the oracle or the harness: the rest is worth nothing. One line.
  std::optional<std::string> fault;
  bool operator==(const Findings&) const = default;
};

/// Adds `from`; of two faults the first stays.
void merge(Findings& into, Findings from);

/// Adds a counterexample, whose case has `found`, unless there is one that failed in the same way
/// and comes before it.
void keep(Findings& findings, records::Counterexample counterexample);

/// Whether keep() would add a case that failed so: what to ask before it is put together.
bool is_kept(const Findings& findings, const cases::Found& found, records::Origin origin,
             const std::string& name);

}  // namespace rastercheck::properties
