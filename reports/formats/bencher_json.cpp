// bencher.json: the figures of a run as Bencher Metric Format, for `bencher run --adapter json`:
//
//   {"LAW on BACKEND: KIND, STRATUM": {"worst": {"value": 0.5, "lower_value": 0.49999999,
//                                                "upper_value": 0.5}, "p99": {…}, …}}
//
// "lower_value" and "upper_value" are the ends of the certified range; "value" is the upper end
// again.

#include <nlohmann/json.hpp>

#include "reports/format.h"
#include "reports/internal/metrics.h"

namespace rastercheck::reports::bencher_json_format {
namespace {

using nlohmann::json;

std::string write(const records::Run& run) {
  json document = json::object();
  for (const MeteredEntry& entry : metered_entries(run)) {
    json& measures = document[entry.name];
    for (const Metric& metric : entry.metrics) {
      measures[std::string(metric.name)] = {{"value", metric.value.hi},
                                            {"lower_value", metric.value.lo},
                                            {"upper_value", metric.value.hi}};
    }
  }
  return document.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

const FormatRegistration kRegistration({"bencher", "bencher.json", &write, true});

}  // namespace
}  // namespace rastercheck::reports::bencher_json_format
