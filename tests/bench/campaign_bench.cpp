// campaign/…: makes, draws and checks cases of each law in one process, and cases of all laws in
// turn, as a campaign does.

#include "tests/bench/campaign_bench.h"

#include <benchmark/benchmark.h>

#include <functional>
#include <span>
#include <string>

#include "properties/campaign/campaign.h"

namespace rastercheck::bench {
namespace {

constexpr std::uint64_t kCases = 20;

void check(benchmark::State& bench, std::span<const properties::Law> laws) {
  properties::TaskRunner runner({.seed = 1}, {});
  for (auto _ : bench) {
    for (const properties::Law& law : laws) {
      const auto found =
          runner.run({"cpu", std::string(law.id), properties::TaskKind::random, 0, kCases});
      if (!found || found->fault) return bench.SkipWithError("the task failed");
    }
  }
  const auto cases = static_cast<double>(kCases * laws.size());
  bench.counters["cases_per_second"] = benchmark::Counter(
      cases * static_cast<double>(bench.iterations()), benchmark::Counter::kIsRate);
}

void add(std::string name, std::span<const properties::Law> laws) {
  for (char& c : name) c = c == ' ' ? '_' : c;
  benchmark::RegisterBenchmark(("campaign/" + name).c_str(), [laws](benchmark::State& bench) {
    check(bench, laws);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_campaigns() {
  const std::span<const properties::Law> all = properties::laws();
  add("all laws", all);
  for (std::size_t i = 0; i < all.size(); ++i) add(std::string(all[i].id), all.subspan(i, 1));
}

}  // namespace rastercheck::bench
