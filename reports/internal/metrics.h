#pragma once

// The figures of a run that services which track performance draw over time: how large errors were,
// by law, backend, kind of value and stratum. Smaller is better of all of them.

#include <string>
#include <vector>

#include "records/enclosure.h"
#include "records/run.h"

namespace rastercheck::reports {

struct Metric {
  std::string_view name;     ///< "worst", "p99", "misrounded"
  std::string_view unit;     ///< "scale ULP", "share of values"
  records::Enclosure value;  ///< finite
};

struct MeteredEntry {
  std::string name;  ///< "LAW on BACKEND: KIND, STRATUM"
  std::vector<Metric> metrics;
};

/// Of every kind and stratum that has values; what is not finite is left out.
std::vector<MeteredEntry> metered_entries(const records::Run& run);

}  // namespace rastercheck::reports
