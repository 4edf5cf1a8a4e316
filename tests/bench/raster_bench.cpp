// raster/…: draw_fragments of the production rasterizer on one thread, with two perspective
// attributes and depth, into 1024×1024, in its modes; and the textbook methods for comparison.

#include "tests/bench/raster_bench.h"

#include <benchmark/benchmark.h>

#include <string>
#include <string_view>

#include "rasterizer/methods/method.h"
#include "tests/bench/bench_scenes.h"

namespace rastercheck::bench {
namespace {

/// The method that also draws every scene, for comparison.
constexpr std::string_view kPeer = "rational-linear";

rasterizer::State two_attributes() {
  rasterizer::State state;
  state.viewport.size = {kTarget, kTarget};
  state.attributes.resize(2);
  return state;
}

/// Draws the scene again and again. An empty `method` means the production rasterizer.
void draw(benchmark::State& bench, const rasterizer::State& state, const Scene& scene,
          std::string_view method) {
  const rasterizer::Mesh mesh = scene.mesh();
  const rasterizer::TargetSize size{kTarget, kTarget, 1};
  std::size_t fragments = 0;
  for (auto _ : bench) {
    rasterizer::Fragments drawn;
    const rasterizer::DrawResult result =
        method.empty() ? rasterizer::draw_fragments(state, mesh, size, drawn)
                       : rasterizer::draw_fragments_by(method, state, mesh, size, drawn);
    if (result.error) return bench.SkipWithError("the draw was refused");
    fragments = drawn.size();
    benchmark::DoNotOptimize(drawn.depth.data());
  }
  const auto rate = [&bench](std::size_t count) {
    return benchmark::Counter(static_cast<double>(count) * static_cast<double>(bench.iterations()),
                              benchmark::Counter::kIsRate);
  };
  bench.counters["triangles_per_second"] = rate(scene.triangles.size());
  bench.counters["fragments_per_second"] = rate(fragments);
}

void add(const std::string& name, const rasterizer::State& state, const Scene& scene,
         std::string_view method) {
  benchmark::RegisterBenchmark(("raster/" + name).c_str(), [=](benchmark::State& bench) {
    draw(bench, state, scene, method);
  })->Unit(benchmark::kMillisecond);
}

/// Adds a scene in every mode of the production rasterizer, and by the peer.
void add(const std::string& name, const Scene& scene) {
  rasterizer::State state = two_attributes();
  add(name, state, scene, "");
  add(std::string(kPeer) + "/" + name, state, scene, kPeer);
  state.precision = rasterizer::Precision::float32;
  add("float32/" + name, state, scene, "");
  state.precision = rasterizer::Precision::float64;
  state.conservative = rasterizer::Conservative::outer;
  add("outer/" + name, state, scene, "");
  state.conservative = rasterizer::Conservative::inner;
  add("inner/" + name, state, scene, "");
  state.conservative = rasterizer::Conservative::off;
  state.snapping = rasterizer::Snapping{8};
  state.basis = rasterizer::Basis::snapped;
  add("snapped/" + name, state, scene, "");
}

const bool kRegistered = [] {
  add("fill", full_triangles(4));
  add("random_1px", random_triangles(20000, 1.3F));
  add("random_8px", random_triangles(20000, 8));
  add("grid_8px", grid_triangles(20000, 8));
  add("random_72px", random_triangles(2000, 72));
  add("random_805px", random_triangles(20, 805));
  return true;
}();

}  // namespace

void register_methods() {
  const Scene scene = random_triangles(2000, 72);
  for (const rasterizer::Method& method : rasterizer::methods()) {
    if (method.name == kPeer) continue;  // drawn for every scene
    add(std::string(method.name) + "/random_72px", two_attributes(), scene, method.name);
  }
}

}  // namespace rastercheck::bench
