// The kernels are compiled once for each SIMD target. The best target that the processor supports
// is chosen at run time.

#include "tests/bench/machine_limits.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <numeric>
#include <thread>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/machine_limits.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include <hwy/highway.h>

// Compiled only once for all targets.
#ifndef RASTERCHECK_TESTS_BENCH_MACHINE_LIMITS
#define RASTERCHECK_TESTS_BENCH_MACHINE_LIMITS
namespace rastercheck::bench {

/// The memory of one thread: 12 bytes for each pixel of a tile.
struct alignas(64) Tile {
  std::array<float, 3 * 64 * 64> values{};
};

/// Enough chains to hide latency, and few enough for the registers of a processor with sixteen.
inline constexpr std::size_t kChains = 12;
inline constexpr int kSteps = 256;

}  // namespace rastercheck::bench
#endif

HWY_BEFORE_NAMESPACE();
namespace rastercheck::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Stores a whole tile. Returns the number of bytes.
double StoreTile(Tile& tile) {
  const hn::ScalableTag<float> d;
  const auto value = hn::Set(d, tile.values[0] + 1);
  for (std::size_t i = 0; i < tile.values.size(); i += hn::Lanes(d)) {
    hn::Store(value, d, tile.values.data() + i);
  }
  return sizeof tile.values;
}

/// Applies `step` again and again to several chains of vectors. Leaves their sum in the tile, so
/// that it must be computed. Returns the number of steps on single numbers.
template <typename Step>
double RunChains(Tile& tile, const Step& step) {
  const hn::ScalableTag<double> d;
  const double first = 1.5 + static_cast<double>(tile.values[0]);
  // The start values must differ, or the compiler could merge the chains.
  const auto start = [&](int chain) HWY_ATTR { return hn::Set(d, first + chain); };
  auto a = start(0), b = start(1), c = start(2), e = start(3), f = start(4), g = start(5);
  auto h = start(6), i = start(7), j = start(8), k = start(9), l = start(10), m = start(11);
  for (int n = 0; n < kSteps; ++n) {
    a = step(a), b = step(b), c = step(c), e = step(e), f = step(f), g = step(g);
    h = step(h), i = step(i), j = step(j), k = step(k), l = step(l), m = step(m);
  }
  const auto left = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)), hn::Add(f, g));
  const auto right = hn::Add(hn::Add(hn::Add(h, i), hn::Add(j, k)), hn::Add(l, m));
  tile.values[1] = static_cast<float>(hn::GetLane(hn::Add(left, right)));
  return static_cast<double>(kChains * kSteps * hn::Lanes(d));
}

/// Returns the number of operations.
double MultiplyAndAdd(Tile& tile) {
  const hn::ScalableTag<double> d;
  const auto half = hn::Set(d, 0.5);
  const auto one = hn::Set(d, 1.0);
  return 2 * RunChains(tile, [&](auto v) HWY_ATTR { return hn::Add(hn::Mul(v, half), one); });
}

double Divide(Tile& tile) {
  const hn::ScalableTag<double> d;
  const auto three = hn::Set(d, 3.0);
  return RunChains(tile, [&](auto v) HWY_ATTR { return hn::Div(three, v); });
}

}  // namespace HWY_NAMESPACE
}  // namespace rastercheck::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rastercheck::bench {

HWY_EXPORT(StoreTile);
HWY_EXPORT(MultiplyAndAdd);
HWY_EXPORT(Divide);

namespace {

using Kernel = std::function<double(Tile&)>;

/// How much a kernel does per second on one thread: the best of a few short spans, as other
/// processes may disturb some.
double rate_of(const Kernel& kernel) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::duration<double> kSpan(0.002);
  constexpr int kCallsBetweenLooks = 16;
  Tile tile;
  double best = 0;
  for (int span = 0; span < 4; ++span) {
    const Clock::time_point start = Clock::now();
    std::chrono::duration<double> taken{};
    double done = 0;
    while (taken < kSpan) {
      for (int call = 0; call < kCallsBetweenLooks; ++call) done += kernel(tile);
      taken = Clock::now() - start;
    }
    best = std::max(best, done / taken.count());
  }
  return best;
}

double rate_of(const Kernel& kernel, unsigned threads) {
  std::vector<double> rates(threads);
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads; ++i) {
    others.emplace_back([&kernel, &rate = rates[i]] { rate = rate_of(kernel); });
  }
  rates[0] = rate_of(kernel);
  for (std::thread& other : others) other.join();
  return std::accumulate(rates.begin(), rates.end(), 0.0);
}

}  // namespace

MachineLimits measure_machine_limits(unsigned threads) {
  return {rate_of([](Tile& tile) { return HWY_DYNAMIC_DISPATCH(StoreTile)(tile); }, threads),
          rate_of([](Tile& tile) { return HWY_DYNAMIC_DISPATCH(MultiplyAndAdd)(tile); }, threads),
          rate_of([](Tile& tile) { return HWY_DYNAMIC_DISPATCH(Divide)(tile); }, threads)};
}

double least_fill_seconds(const MachineLimits& limits, double pixels) {
  constexpr double kBytes = 12;
  constexpr double kOperations = 4 * 2 + 2;
  return pixels * std::max({kBytes / limits.stored_bytes, kOperations / limits.operations,
                            1 / limits.divisions});
}

}  // namespace rastercheck::bench
#endif  // HWY_ONCE
