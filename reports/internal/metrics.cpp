#include "reports/internal/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "records/histogram.h"
#include "records/summary.h"
#include "reports/internal/wording.h"

namespace rastercheck::reports {
namespace {

void add(std::vector<Metric>& metrics, const Metric& metric) {
  if (std::isfinite(metric.value.lo) && std::isfinite(metric.value.hi)) metrics.push_back(metric);
}

/// An enclosure of the greater of |min| and |max|.
records::Enclosure worst_of(const records::Precision& precision) {
  const records::Enclosure below{-precision.min.hi, -precision.min.lo};
  return below.hi > precision.max.hi ? below : precision.max;
}

}  // namespace

std::vector<MeteredEntry> metered_entries(const records::Run& run) {
  std::vector<MeteredEntry> entries;
  for (const records::LawSummary& row : records::summarize(run)) {
    for (const records::Precision& precision : row.precision) {
      MeteredEntry entry;
      entry.name = fmt::format("{} on {}: {}, {}", row.law, row.backend, to_string(precision.kind),
                               stratum_text(precision));
      constexpr std::string_view kUlp = "scale ULP";
      add(entry.metrics, {"worst", kUlp, worst_of(precision)});
      if (precision.p50) add(entry.metrics, {"p50", kUlp, *precision.p50});
      if (precision.p99) add(entry.metrics, {"p99", kUlp, *precision.p99});
      const double share =
          static_cast<double>(precision.misrounded) / static_cast<double>(precision.values);
      add(entry.metrics, {"misrounded", "share of values", {share, share}});
      entries.push_back(std::move(entry));
    }
  }
  return entries;
}

}  // namespace rastercheck::reports
