#pragma once

// A probe's findings about a backend, as plain data (properties/probing/probe.h).

#include <cstdint>
#include <string>
#include <vector>

#include "cases/contract_terms.h"

namespace rastercheck::records {

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
  bool operator==(const Measured&) const = default;
};

struct Probe {
  std::string backend;  ///< specification
  std::string description;
  std::uint64_t seed = 0;
  std::vector<Measured> rows;
  std::uint64_t drawings = 0;     ///< cases drawn
  std::uint64_t unsupported = 0;  ///< cases that the backend reports as unsupported
  std::uint64_t failed = 0;       ///< drawings that failed for another reason
  std::string failure;            ///< why the first of these failed
  /// The measurements as contract terms.
  cases::ContractTerms terms;
  bool operator==(const Probe&) const = default;
};

}  // namespace rastercheck::records
