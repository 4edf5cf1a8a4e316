// backend/…: the cost of drawing in a process of the backend's own. For backend/worker, the same
// case is drawn alternately in this process and in the other one, and the counter is the median of
// the differences. The programs of backend/exec draw next to nothing, so all of their time is the
// cost of asking and answering.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "backends/factory.h"
#include "backends/isolation.h"

namespace rastercheck::bench {
namespace {

/// A triangle over half of a square framebuffer, with attributes.
cases::Case half_case(int size, int attributes) {
  cases::Case c;
  c.framebuffer = {size, size, 1};
  c.viewport.width = static_cast<float>(size);
  c.viewport.height = static_cast<float>(size);
  c.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 1, 0, 1}};
  c.triangles = {{0, 1, 2}};
  for (int i = 0; i < attributes; ++i) {
    c.attributes.push_back({fmt::format("a{}", i), {}, {}});
  }
  c.attribute_values.resize(c.positions.size() * c.attributes.size(), 1);
  return c;
}

double seconds_of(backends::Backend& backend, const cases::Case& c) {
  const auto start = std::chrono::steady_clock::now();
  const auto drawn = backend.draw(c);
  benchmark::DoNotOptimize(drawn);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  return passed.count();
}

void draw_isolated(benchmark::State& bench) {
  backends::Isolation isolation;
  isolation.command = {RASTERCHECK_BENCH_PROGRAM, "worker"};
  const auto direct = backends::make_backend("cpu");
  const auto isolated = backends::make_isolated_backend("cpu", isolation);
  if (!direct || !isolated) return bench.SkipWithError("the backend cannot be made");
  const cases::Case c = half_case(static_cast<int>(bench.range(0)), 4);
  std::vector<double> more;
  for (auto _ : bench) {
    const double here = seconds_of(**direct, c);
    const double there = seconds_of(**isolated, c);
    more.push_back(there - here);
    bench.SetIterationTime(there);
  }
  const auto middle = more.begin() + static_cast<std::ptrdiff_t>(more.size() / 2);
  std::nth_element(more.begin(), middle, more.end());
  constexpr double kMicroseconds = 1e6;
  bench.counters["overhead_us"] = *middle * kMicroseconds;
}
BENCHMARK(draw_isolated)
    ->Name("backend/worker/pixels")
    ->Arg(16)
    ->Arg(64)
    ->Arg(256)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// The time from a process's start to its first answer, which is the cost of a crash.
void start_process(benchmark::State& bench) {
  backends::Isolation isolation;
  isolation.command = {RASTERCHECK_BENCH_PROGRAM, "worker"};
  for (auto _ : bench) {
    const auto isolated = backends::make_isolated_backend("cpu", isolation);
    if (!isolated) return bench.SkipWithError("the backend cannot be made");
  }
}
BENCHMARK(start_process)->Name("backend/worker/start")->Unit(benchmark::kMicrosecond);

/// The time of a driver's drawing, including the transfers to and from its process.
void draw_with_driver(benchmark::State& bench, const char* specification) {
  backends::Isolation isolation;
  isolation.command = {RASTERCHECK_BENCH_PROGRAM, "worker"};
  const auto backend = backends::make_isolated_backend(specification, isolation);
  if (!backend) return bench.SkipWithError(backend.error().reason.c_str());
  const cases::Case c = half_case(static_cast<int>(bench.range(0)), 4);
  // The first drawing compiles programs, and the first few are checked for leaks.
  for (int i = 0; i < 20; ++i) seconds_of(**backend, c);
  for (auto _ : bench) bench.SetIterationTime(seconds_of(**backend, c));
}
BENCHMARK_CAPTURE(draw_with_driver, llvmpipe, "gl:llvmpipe")
    ->Name("backend/gl/llvmpipe")
    ->Arg(16)
    ->Arg(64)
    ->Arg(256)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(draw_with_driver, softpipe, "gl:softpipe")
    ->Name("backend/gl/softpipe")
    ->Arg(16)
    ->Arg(64)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// The time of asking a program, and of taking its answer.
void ask_program(benchmark::State& bench, const char* command) {
  const auto backend = backends::make_backend(std::string("exec:") + command);
  if (!backend) return bench.SkipWithError(backend.error().reason.c_str());
  const cases::Case c = half_case(static_cast<int>(bench.range(0)), 3);
  if (!(*backend)->draw(c)) return bench.SkipWithError("the program does not draw");
  for (auto _ : bench) benchmark::DoNotOptimize((*backend)->draw(c));
}
void register_program(const char* name, const char* command) {
  benchmark::RegisterBenchmark(name, ask_program, command)
      ->Arg(64)
      ->Arg(256)
      ->UseRealTime()
      ->Unit(benchmark::kMicrosecond);
}
const bool kAreRegistered = [] {
  register_program("backend/exec/c", RASTERCHECK_BENCH_EXEC_PROGRAM);
  register_program("backend/exec/c-shared-memory",
                   RASTERCHECK_BENCH_EXEC_PROGRAM " --shared-memory");
  register_program("backend/exec/python", RASTERCHECK_BENCH_EXEC_PYTHON);
  return true;
}();

}  // namespace
}  // namespace rastercheck::bench
