// report/…: a run's reports made again from its run.json: reading the file, writing each format,
// and the whole command as a process, with the most memory that it took.
//
// The run is a default one with 50 cases per law, or the one that the environment names. The
// figures for a large run are taken in this way:
//
//   rastercheck run --cases 22223 --output DIR
//   RASTERCHECK_BENCH_RUN=DIR rastercheck-bench --benchmark_filter=report
//
// report/compare: the regression gate as a process, comparing two baselines of 20,000 cases.

#include "tests/bench/report_bench.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "cases/child_process.h"
#include "records/baseline_json.h"
#include "reports/format.h"
#include "reports/run_reader.h"
#include "tests/temporary_folder.h"

namespace rastercheck::bench {
namespace {

/// The folder of the run that is reported, made on first request; empty if it cannot be made.
const std::string& run_folder() {
  static const TemporaryFolder temporary;
  static const std::string folder = [] {
    if (const char* given = std::getenv("RASTERCHECK_BENCH_RUN")) return std::string(given);
    const auto made = cases::run_child({RASTERCHECK_BENCH_PROGRAM, "run", "--cases", "50", "--seed",
                                        "1", "--quiet", "--output", temporary.path()},
                                       1 << 20);
    return made && made->end.signal == 0 && made->end.exit_code == 0 ? temporary.path()
                                                                     : std::string();
  }();
  return folder;
}

Result<records::Run> read() { return reports::read_run(run_folder() + "/run.json"); }

void count_cases(benchmark::State& bench, const records::Run& run) {
  std::uint64_t cases = 0;
  for (const auto& [key, record] : run.records) cases += record.cases.checked;
  bench.counters["cases"] = static_cast<double>(cases);
}

void read_again(benchmark::State& bench) {
  for (auto _ : bench) {
    const Result<records::Run> run = read();
    if (!run) return bench.SkipWithError(to_string(run.error()).c_str());
    count_cases(bench, *run);
  }
}

void write(benchmark::State& bench, const reports::Format& format) {
  const Result<records::Run> run = read();
  if (!run) return bench.SkipWithError(to_string(run.error()).c_str());
  std::size_t bytes = 0;
  for (auto _ : bench) bytes = format.write(*run).size();
  bench.counters["bytes"] = static_cast<double>(bytes);
  count_cases(bench, *run);
}

/// Runs `rastercheck report` from start to end.
void report(benchmark::State& bench) {
  if (run_folder().empty()) return bench.SkipWithError("there is no run");
  double most_memory = 0;
  for (auto _ : bench) {
    const auto outcome =
        cases::run_child({RASTERCHECK_BENCH_PROGRAM, "report", run_folder(), "--quiet"}, 1 << 20);
    if (!outcome || outcome->end.exit_code != 0) return bench.SkipWithError("it failed");
    most_memory = static_cast<double>(outcome->end.most_memory);
  }
  bench.counters["peak_MiB"] = most_memory / 0x1p20;
}

/// A section as large as that of a run of every law with 100 random cases each. Every eighth case
/// has an error, whose size is `error`.
records::BaselineSection large_section(double error) {
  constexpr std::uint64_t kLaws = 46;
  constexpr std::uint64_t kCases = 435;
  constexpr std::uint64_t kEvery = 8;
  records::BaselineSection section;
  section.key = {"cpu", "x86_64", "", ""};
  section.taken.backend = "cpu";
  records::WorstError worst;
  worst.error = {error, error};
  worst.exact = "24819056350239761910/242700891750327123968";
  for (std::uint64_t i = 0; i < kLaws; ++i) {
    const std::string law =
        "a law of the bench, which has a long name: number " + std::to_string(i);
    for (const auto stratum : {records::Stratum::clipped, records::Stratum::sliver,
                               records::Stratum::multisampled, records::Stratum::ordinary}) {
      auto& figures = section.entries[{law, records::AttributeKind::smooth, stratum}];
      figures.worst = worst.error;
      for (std::size_t bucket = 100; bucket < 160; ++bucket) {
        figures.histogram.add_to_bucket(bucket, bucket);
      }
    }
    records::LawCases& cases = section.laws[law];
    cases.count = kCases;
    for (std::uint64_t k = 0; k < kCases; ++k) {
      worst.case_index = k;
      records::CaseFigures& figures = cases.cases[{records::Origin::random, k}];
      figures.found_digest = static_cast<std::uint64_t>(error * 1024) + k;
      if (k % kEvery == 0) {
        figures.worst[records::AttributeKind::smooth][records::Stratum::sliver] = worst;
      }
    }
  }
  return section;
}

/// Runs `rastercheck compare` from start to end, on two files in which every case differs.
void compare(benchmark::State& bench) {
  constexpr int kRegression = 3;
  const TemporaryFolder folder;
  const std::string before = folder.put("before.json", records::to_json({{large_section(0.5)}}));
  const std::string after = folder.put("after.json", records::to_json({{large_section(0.75)}}));
  double most_memory = 0;
  for (auto _ : bench) {
    const auto outcome =
        cases::run_child({RASTERCHECK_BENCH_PROGRAM, "compare", before, after}, 1 << 20);
    if (!outcome || outcome->end.exit_code != kRegression) return bench.SkipWithError("it failed");
    most_memory = static_cast<double>(outcome->end.most_memory);
  }
  bench.counters["peak_MiB"] = most_memory / 0x1p20;
}

}  // namespace

void register_reports() {
  benchmark::RegisterBenchmark("report/whole", &report)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  benchmark::RegisterBenchmark("report/compare", &compare)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  benchmark::RegisterBenchmark("report/read", &read_again)->Unit(benchmark::kMillisecond);
  for (const reports::Format& format : reports::formats()) {
    benchmark::RegisterBenchmark(("report/" + std::string(format.name)).c_str(),
                                 [format](benchmark::State& bench) { write(bench, format); })
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace rastercheck::bench
