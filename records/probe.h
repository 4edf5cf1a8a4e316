#pragma once

// What a probe found of a backend, as plain data (properties/probing/probe.h).

#include <cstdint>
#include <string>
#include <vector>

#include "cases/contract_terms.h"

namespace rastercheck::records {

/// One thing that was measured, in words.
struct Measured {
  std::string what;      ///< "subpixel grid"
  std::string declared;  ///< by the backend's own contract; "–" where contracts say nothing of it
  std::string measured;
  std::string detail;  ///< how sure, of how many samples; may be empty
  bool operator==(const Measured&) const = default;
};

struct Probe {
  std::string backend;  ///< specification
  std::string description;
  std::uint64_t seed = 0;
  std::vector<Measured> rows;
  std::uint64_t drawings = 0;     ///< cases drawn
  std::uint64_t unsupported = 0;  ///< cases that the backend does not draw, and says so
  std::uint64_t failed = 0;       ///< drawings that failed otherwise
  std::string failure;            ///< why the first of these did
  /// What was measured, as promises.
  cases::ContractTerms terms;
  bool operator==(const Probe&) const = default;
};

}  // namespace rastercheck::records
