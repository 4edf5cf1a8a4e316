// raster/draw…/threads:T/SCENE, raster/llvmpipe…/threads:T/width:W/SCENE, raster/lavapipe… and
// raster/swiftshader…/threads:T/SCENE: whole frames, cleared and drawn with a depth test, with two
// perspective attributes in float32 (frame_scenes.h). Our frames are drawn by `draw`. Drivers
// (driver_peer.h) draw into depth32F in the same run, in processes of their own.
//
//   draw             exact coverage, values in double, one sample per pixel
//   draw-avx2        the same with vectors of 256 bits, if the processor has longer ones
//   draw-samples:4   four samples per pixel
//   draw-snapped:8   coverage and values of triangles on the grid of 2^-8 pixels, as in drivers
//   draw-outer, draw-inner   conservative coverage
//   draw-float32     Precision::float32, which does not affect framebuffers: the same as draw
//   llvmpipe             into RGBA32F
//   llvmpipe-rgba8       into bytes: its best format, while ours writes two floats per pixel
//   llvmpipe-samples:4   four samples per pixel, RGBA32F
//   lavapipe, lavapipe-samples:4, swiftshader, swiftshader-samples:4     the same, by Vulkan
//
// raster/beside/threads:T/SCENE: `draw`, with one frame by each driver after each of our frames.
// The time is ours. ratio_llvmpipe, ratio_lavapipe and ratio_swiftshader are the driver's median
// time over our median time. The label names drivers that cannot run here or draw another picture,
// and says why.
//
// fraction_of_limit, for filled frames: the least time in which the machine can fill the frame
// (machine_limits.h) over the time taken. The limit is measured before each repetition, on as many
// threads.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/driver_peer.h"
#include "tests/bench/frame_scenes.h"
#include "tests/bench/frame_timing.h"
#include "tests/bench/machine_limits.h"
#include "tests/bench/summary.h"
#include "tests/on_target.h"

namespace rastercheck::bench {
namespace {

/// One of our modes: the settings in which it differs from the others.
struct Mode {
  std::string name = "draw";
  int samples = 1;
  std::optional<rasterizer::Snapping> snapping = {};
  rasterizer::Precision precision = rasterizer::Precision::float64;
  bool on_avx2 = false;
  /// If set, no kernel draws, because the viewport's origin is off the grid of 1/256 pixel.
  bool by_fallback = false;
  rasterizer::Conservative conservative = rasterizer::Conservative::off;
};

rasterizer::State state_of(const Mode& mode, const Scene& scene) {
  rasterizer::State state;
  state.viewport.size = scene.size;
  if (mode.by_fallback) state.viewport.origin = {1.0F / 512, 0};
  state.attributes.resize(2);
  state.depth_test = rasterizer::DepthTest::less;
  state.snapping = mode.snapping;
  if (mode.snapping) state.basis = rasterizer::Basis::snapped;
  state.precision = mode.precision;
  state.conservative = mode.conservative;
  return state;
}

/// Draws a frame. Returns false if the draw was refused.
bool draw_frame(const rasterizer::State& state, const Scene& scene, int samples,
                rasterizer::Picture& framebuffer, unsigned threads = 1) {
  const rasterizer::TargetSize size{scene.size.x, scene.size.y, samples};
  return !rasterizer::clear_and_draw(state, scene.mesh(), size, 1, framebuffer, threads).error;
}

/// The summary of our picture of a scene, which must exist. Drawn on first request.
const Result<Summary>& summary_of(const std::string& name, int samples) {
  static std::map<std::pair<std::string, int>, Result<Summary>> drawn;
  const auto known = drawn.find({name, samples});
  if (known != drawn.end()) return known->second;
  const Scene& scene = *frame_scene(name);
  rasterizer::Picture framebuffer;
  Result<Summary> summary = tl::unexpected(Error{"", "", "the draw was refused"});
  if (draw_frame(state_of({}, scene), scene, samples, framebuffer)) {
    summary = summarize(framebuffer.depth, framebuffer.attributes, 2);
  }
  return drawn.emplace(std::pair{name, samples}, std::move(summary)).first->second;
}

bool has_more_than_avx2() {
  // Highway's targets of a processor are bits; a better target is a lower bit.
  return (hwy::SupportedTargets() & HWY_AVX2) != 0 &&
         (hwy::SupportedTargets() & (HWY_AVX2 - 1)) != 0;
}

void draw(benchmark::State& bench, const std::string& name, const Mode& mode, unsigned threads) {
  const Result<Scene>& scene = frame_scene(name);
  if (!scene) return bench.SkipWithError(to_string(scene.error()).c_str());
  std::optional<OnTarget> target;
  if (mode.on_avx2) {
    if (!has_more_than_avx2()) return bench.SkipWithError("the processor has no more than AVX2");
    target.emplace(HWY_AVX2);
  }
  const bool has_limit = name.starts_with("fill") && mode.samples == 1 && !mode.snapping &&
                         !mode.by_fallback && mode.conservative == rasterizer::Conservative::off &&
                         mode.precision == rasterizer::Precision::float64;
  MachineLimits limits;
  if (has_limit) limits = measure_machine_limits(threads);

  const rasterizer::State state = state_of(mode, *scene);
  rasterizer::Picture framebuffer;
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : bench) {
    if (!draw_frame(state, *scene, mode.samples, framebuffer, threads)) {
      return bench.SkipWithError("refused");
    }
    benchmark::DoNotOptimize(framebuffer.depth.data());
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  set_rates(bench, name);
  if (has_limit) {
    bench.counters["fraction_of_limit"] = least_fill_seconds(limits, scene_area(name)) *
                                          static_cast<double>(bench.iterations()) / taken.count();
  }
}

void draw_by(benchmark::State& bench, const std::string& name, const PeerTarget& target,
             const Configuration& configuration) {
  const Result<Scene>& scene = frame_scene(name);
  if (!scene) return bench.SkipWithError(to_string(scene.error()).c_str());
  const Result<Summary>& summary = summary_of(name, target.samples);
  if (!summary) return bench.SkipWithError(to_string(summary.error()).c_str());
  DriverPeer& peer = driver_peer(configuration);
  if (const Result<void> ready = peer.take(name, target, *summary); !ready) {
    return bench.SkipWithError(
        fmt::format("no {}: {}", configuration.driver, to_string(ready.error())).c_str());
  }
  time_frames_of(peer, bench, name);
}

/// A driver that draws after each of our frames, and its times.
struct Beside {
  std::string driver;
  DriverPeer* peer = nullptr;
  std::vector<double> seconds;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The drivers that draw the scene on this many threads. The label says why other drivers do not.
std::vector<Beside> drivers_beside(benchmark::State& bench, const std::string& name,
                                   unsigned threads, const Summary& summary) {
  std::vector<Configuration> all = llvmpipe_configurations();
  // Keeps only the default of llvmpipe's two widths, which lavapipe has as well.
  std::erase_if(all, [](const Configuration& c) { return !c.name.ends_with("width:default"); });
  for (const Configuration& configuration : vulkan_configurations()) all.push_back(configuration);
  std::vector<Beside> beside;
  std::string missing;
  for (const Configuration& configuration : all) {
    if (!configuration.name.starts_with(fmt::format("threads:{}", threads))) continue;
    DriverPeer& peer = driver_peer(configuration);
    if (const Result<void> ready = peer.take(name, {}, summary); !ready) {
      missing += fmt::format("{}no {}: {}", missing.empty() ? "" : "; ", configuration.driver,
                             to_string(ready.error()));
    } else {
      beside.push_back({configuration.driver, &peer, {}});
    }
  }
  bench.SetLabel(missing);
  return beside;
}

void draw_beside(benchmark::State& bench, const std::string& name, unsigned threads) {
  const Result<Scene>& scene = frame_scene(name);
  if (!scene) return bench.SkipWithError(to_string(scene.error()).c_str());
  const Result<Summary>& summary = summary_of(name, 1);
  if (!summary) return bench.SkipWithError(to_string(summary.error()).c_str());
  std::vector<Beside> all = drivers_beside(bench, name, threads, *summary);
  const rasterizer::State state = state_of({}, *scene);
  rasterizer::Picture framebuffer;
  std::vector<double> ours;
  for (auto _ : bench) {
    const auto start = std::chrono::steady_clock::now();
    if (!draw_frame(state, *scene, 1, framebuffer, threads)) return bench.SkipWithError("refused");
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    ours.push_back(taken.count());
    bench.SetIterationTime(taken.count());
    for (Beside& one : all) {
      const Result<double> seconds = one.peer->draw();
      if (!seconds) return bench.SkipWithError(to_string(seconds.error()).c_str());
      one.seconds.push_back(*seconds);
    }
  }
  set_rates(bench, name);
  for (const Beside& one : all) {
    bench.counters["ratio_" + one.driver] = median(one.seconds) / median(ours);
  }
}

void add(const std::string& name, const Mode& mode) {
  for (const unsigned threads : {1U, 2U}) {
    benchmark::RegisterBenchmark(
        fmt::format("raster/{}/threads:{}/{}", mode.name, threads, name).c_str(),
        [=](benchmark::State& bench) { draw(bench, name, mode, threads); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
}

/// Adds benchmarks of drivers. `what` follows the driver's name and says how it draws.
void add(const std::string& name, const std::string& what, const PeerTarget& target,
         const std::vector<Configuration>& configurations) {
  for (const Configuration& configuration : configurations) {
    benchmark::RegisterBenchmark(
        fmt::format("raster/{}{}/{}/{}", configuration.driver, what, configuration.name, name)
            .c_str(),
        [=](benchmark::State& bench) { draw_by(bench, name, target, configuration); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
  }
}

void add_beside(const std::string& name) {
  for (const unsigned threads : {1U, 2U}) {
    benchmark::RegisterBenchmark(
        fmt::format("raster/beside/threads:{}/{}", threads, name).c_str(),
        [=](benchmark::State& bench) { draw_beside(bench, name, threads); })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
  }
}

const bool kRegistered = [] {
  for (const std::string_view scene : frame_scenes()) {
    const std::string name(scene);
    add(name, Mode{});
    add(name, Mode{.name = "draw-avx2", .on_avx2 = true});
    add(name, "", {}, llvmpipe_configurations());
    add(name, "-rgba8", {"rgba8"}, llvmpipe_configurations());
    add(name, "", {}, vulkan_configurations());
    add_beside(name);
  }
  for (const std::string name : {"fill_32_layers", "random_8px", "random_72px", "bunny"}) {
    add(name, Mode{.name = "draw-samples:4", .samples = 4});
    add(name, Mode{.name = "draw-snapped:8", .snapping = rasterizer::Snapping{8}});
    add(name, Mode{.name = "draw-float32", .precision = rasterizer::Precision::float32});
    add(name, Mode{.name = "draw-fallback", .by_fallback = true});
    add(name, Mode{.name = "draw-outer", .conservative = rasterizer::Conservative::outer});
    add(name, Mode{.name = "draw-inner", .conservative = rasterizer::Conservative::inner});
    add(name, "-samples:4", {"rgba32f", 4}, llvmpipe_configurations());
    add(name, "-samples:4", {"rgba32f", 4}, vulkan_configurations());
  }
  return true;
}();

}  // namespace
}  // namespace rastercheck::bench
