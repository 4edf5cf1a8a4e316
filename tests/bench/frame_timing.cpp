#include "tests/bench/frame_timing.h"

#include <map>

#include "tests/bench/frame_scenes.h"

namespace rastercheck::bench {

double scene_area(const std::string& name) {
  static std::map<std::string, double> areas;
  const auto [area, is_new] = areas.try_emplace(name);
  if (is_new) area->second = drawn_area(*frame_scene(name));
  return area->second;
}

void set_rates(benchmark::State& bench, const std::string& name) {
  const auto rate = [&bench](double count) {
    return benchmark::Counter(count * static_cast<double>(bench.iterations()),
                              benchmark::Counter::kIsRate);
  };
  bench.counters["triangles_per_second"] =
      rate(static_cast<double>(frame_scene(name)->triangles.size()));
  // Counts hidden pixels as well: in fill_32_layers, all of them are shaded.
  bench.counters["pixels_per_second"] = rate(scene_area(name));
}

void time_frames_of(DriverPeer& peer, benchmark::State& bench, const std::string& name) {
  for (auto _ : bench) {
    const Result<double> seconds = peer.draw();
    if (!seconds) return bench.SkipWithError(to_string(seconds.error()).c_str());
    bench.SetIterationTime(*seconds);
  }
  bench.SetLabel(peer.renderer());
  set_rates(bench, name);
}

}  // namespace rastercheck::bench
