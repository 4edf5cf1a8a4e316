#pragma once

// A probe's findings about a backend, as plain data (properties/probing/probe.h).

#include <cstdint>
#include <string>
#include <vector>

#include "cases/contract_terms.h"

namespace rastercheck::records {

/// How sure a finding is: how many samples, cases or triangles (`unit`) speak for it.
struct Sureness {
  std::string unit;  ///< in plural: "samples"; empty if nothing was counted
  std::uint64_t in_favour = 0;
  std::uint64_t against = 0;
  std::uint64_t undecided = 0;  ///< seen, but right either way
  bool operator==(const Sureness&) const = default;
};

/// A fault after which no measurement would mean anything, such as a picture upside down.
struct DrawingFault {
  std::string id;        ///< "upside-down"
  std::string sentence;  ///< "The picture is upside down: …"
  Sureness sureness;
  bool operator==(const DrawingFault&) const = default;
};

/// One measurement, in words.
struct Measured {
  std::string what;  ///< "subpixel grid"
  /// The value in the backend's own contract; "–" if contracts do not cover the quantity.
  std::string declared;
  std::string measured;
  std::string detail;  ///< certainty, number of samples; may be empty
  /// True if the backend does not keep what it declares. A backend that is better than declared
  /// does not contradict itself.
  bool contradicts = false;
  Sureness sureness = {};
  bool operator==(const Measured&) const = default;
};

/// A measure that was not made, as the time was up before it ended.
struct Unmeasured {
  std::string what;               ///< "tie rule"
  std::vector<std::string> keys;  ///< the contract's keys that it would have set
  bool operator==(const Unmeasured&) const = default;
};

struct Probe {
  std::string backend;  ///< specification
  std::string description;
  std::uint64_t seed = 0;
  /// If not empty, the probe ended before its first measure: there are neither rows nor terms.
  std::vector<DrawingFault> faults;
  std::vector<Measured> rows;
  std::uint64_t measures = 0;  ///< measures made
  std::vector<Unmeasured> unmeasured;
  std::uint64_t drawings = 0;     ///< cases drawn
  std::uint64_t unsupported = 0;  ///< cases that the backend reports as unsupported
  std::uint64_t failed = 0;       ///< drawings that failed for another reason
  std::string failure;            ///< why the first of these failed
  /// The measurements as contract terms.
  cases::ContractTerms terms;
  bool operator==(const Probe&) const = default;
};

}  // namespace rastercheck::records
