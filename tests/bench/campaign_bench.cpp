// campaign/…: cases of each law, made, drawn and checked, in one process.

#include <benchmark/benchmark.h>

#include "properties/campaign.h"

namespace rastercheck::bench {
namespace {

constexpr std::uint64_t kCases = 20;

const bool kRegistered = [] {
  for (const properties::Law& law : properties::laws()) {
    std::string name(law.name);
    for (char& c : name) c = c == ' ' ? '_' : c;
    benchmark::RegisterBenchmark(("campaign/" + name).c_str(), [&law](benchmark::State& bench) {
      properties::TaskRunner runner(1, {});
      for (auto _ : bench) {
        const auto found = runner.run({"cpu", std::string(law.name), false, 0, kCases});
        if (!found || found->fault) return bench.SkipWithError("the task failed");
      }
      bench.counters["cases_per_second"] =
          benchmark::Counter(static_cast<double>(kCases) * static_cast<double>(bench.iterations()),
                             benchmark::Counter::kIsRate);
    })->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace rastercheck::bench
