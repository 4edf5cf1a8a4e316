#pragma once

// The figures of a run that performance-tracking services plot over time: sizes of errors by law,
// backend, kind of value and stratum. For every figure, smaller is better.

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
  std::string name;  ///< "PROPERTY on BACKEND: KIND, STRATUM"
  std::vector<Metric> metrics;
};

/// The figures of every kind and stratum that has values. Figures that are not finite are left out.
std::vector<MeteredEntry> metered_entries(const records::Run& run);

}  // namespace rastercheck::reports
