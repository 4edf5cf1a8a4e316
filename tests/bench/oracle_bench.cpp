// oracle/…: the judge, with the contract of the production rasterizer (exact coverage) and with
// that of the textbook method (all placements of snapped vertices open).

#include <benchmark/benchmark.h>

#include "backends/backend.h"
#include "oracle/judge.h"
#include "tests/bench/bench_scenes.h"

namespace rastercheck::bench {
namespace {

cases::Case to_case(const Scene& scene) {
  cases::Case c;
  c.framebuffer = {kTarget, kTarget, 1};
  c.viewport.width = kTarget;
  c.viewport.height = kTarget;
  c.attributes = {{"u", {}, {}}, {"v", {}, {}}};
  for (const glm::vec4& p : scene.positions) c.positions.push_back({p.x, p.y, p.z, p.w});
  c.attribute_values = scene.attributes;
  for (const glm::uvec3& t : scene.triangles) c.triangles.push_back({t.x, t.y, t.z});
  return c;
}

void judge(benchmark::State& bench, const Scene& scene, const std::string& specification) {
  const cases::Case c = to_case(scene);
  auto backend = backends::make_backend(specification);
  if (!backend) return bench.SkipWithError("no such backend");
  const auto drawn = (*backend)->draw(c);
  if (!drawn) return bench.SkipWithError("the draw was refused");
  for (auto _ : bench) {
    const oracle::SceneTruth truth(c, (*backend)->contract(c));
    benchmark::DoNotOptimize(oracle::judge(truth, *drawn));
  }
  bench.counters["fragments_per_second"] = benchmark::Counter(
      static_cast<double>(drawn->size()) * static_cast<double>(bench.iterations()),
      benchmark::Counter::kIsRate);
}

void add(const std::string& name, const std::string& specification, const Scene& scene) {
  benchmark::RegisterBenchmark(("oracle/judge/" + name).c_str(), [=](benchmark::State& bench) {
    judge(bench, scene, specification);
  })->Unit(benchmark::kMillisecond);
}

const bool kRegistered = [] {
  add("exact/random_72px", "cpu", random_triangles(20, 72));
  add("exact/grid_8px", "cpu", grid_triangles(200, 8));
  add("placements/random_72px", "method:rational-linear", random_triangles(20, 72));
  return true;
}();

}  // namespace
}  // namespace rastercheck::bench
