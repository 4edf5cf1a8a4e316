// benchmark.json: the figures of a run for github-action-benchmark, `tool: customSmallerIsBetter`:
//
//   [{"name": "LAW on BACKEND: KIND, STRATUM, worst", "unit": "scale ULP", "value": 0.5}, …]
//
// Values are the upper ends of certified ranges.

#include <nlohmann/json.hpp>

#include "reports/format.h"
#include "reports/internal/metrics.h"

namespace rastercheck::reports::benchmark_json_format {
namespace {

using nlohmann::json;

std::string write(const records::Run& run) {
  json document = json::array();
  for (const MeteredEntry& entry : metered_entries(run)) {
    for (const Metric& metric : entry.metrics) {
      document.push_back({{"name", entry.name + ", " + std::string(metric.name)},
                          {"unit", metric.unit},
                          {"value", metric.value.hi}});
    }
  }
  return document.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

const FormatRegistration kRegistration({"benchmark", "benchmark.json", &write, true});

}  // namespace
}  // namespace rastercheck::reports::benchmark_json_format
