// rastercheck-bench: the files in this folder register their benchmarks themselves, except those
// that depend on other registrations, which main() adds.

#include <benchmark/benchmark.h>

#include "tests/bench/campaign_bench.h"
#include "tests/bench/raster_bench.h"
#include "tests/bench/report_bench.h"

int main(int argc, char** argv) {
  rastercheck::bench::register_campaigns();
  rastercheck::bench::register_methods();
  rastercheck::bench::register_reports();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
