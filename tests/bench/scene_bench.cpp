// scene/BACKEND/SCENE: draws a whole scene without a depth test and judges every fragment in two
// threads, as `rastercheck run --scene` does. Counters: fragments, the share of samples for which
// the contract leaves nothing open, the seconds of drawing (with the transfers to and from the
// driver's process), and the seconds of judging.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "backends/isolation.h"
#include "properties/campaign/scene.h"
#include "properties/judged_law.h"
#include "tests/bench/frame_scenes.h"
#include "tests/bench/mesh_scenes.h"

namespace rastercheck::bench {
namespace {

/// The scenes, by name: those of mesh_scenes.h, and one with many triangles in a large target.
constexpr std::string_view kJudgedScenes[] = {"bunny@512x512", "armadillo", "engine", "castle",
                                              "random_8px@1920x1080"};

cases::Case case_of(const Scene& scene, std::string name) {
  cases::Case c;
  c.name = std::move(name);
  c.framebuffer = {scene.size.x, scene.size.y, 1};
  c.viewport.width = static_cast<float>(scene.size.x);
  c.viewport.height = static_cast<float>(scene.size.y);
  c.attributes = {{"u"}, {"v"}};
  for (const glm::vec4& p : scene.positions) c.positions.push_back({p.x, p.y, p.z, p.w});
  c.attribute_values = scene.attributes;
  for (const glm::uvec3& t : scene.triangles) c.triangles.push_back({t.x, t.y, t.z});
  return c;
}

/// The scene with that name, made on first request.
const Result<cases::Case>& judged_scene(std::string_view name) {
  static std::map<std::string, Result<cases::Case>, std::less<>> made;
  const auto known = made.find(name);
  if (known != made.end()) return known->second;
  const Result<Scene> scene = name == "bunny@512x512" ? bunny({512, 512}) : frame_scene(name);
  Result<cases::Case> c = tl::unexpected(scene ? Error() : scene.error());
  if (scene) c = case_of(*scene, std::string(name));
  return made.emplace(name, std::move(c)).first->second;
}

/// Draws with another backend and measures the time.
class TimedBackend final : public backends::Backend {
 public:
  explicit TimedBackend(backends::Backend& inner) : inner_(&inner) {}

  backends::About about() const override { return inner_->about(); }
  std::optional<Error> is_lost() const override { return inner_->is_lost(); }
  cases::Contract promise(const cases::Case& c) const override { return inner_->promise(c); }
  double seconds() const { return seconds_.count(); }

 private:
  Result<cases::Fragments> draw_fragments(const cases::Case& c) override {
    const auto start = std::chrono::steady_clock::now();
    Result<cases::Fragments> drawn = inner_->draw_unjudged(c);
    seconds_ += std::chrono::steady_clock::now() - start;
    return drawn;
  }

  backends::Backend* inner_;
  std::chrono::duration<double> seconds_{0};
};

void judge(benchmark::State& bench, const std::string& specification, std::string_view name) {
  const Result<cases::Case>& scene = judged_scene(name);
  if (!scene) return bench.SkipWithError(to_string(scene.error()).c_str());
  backends::Isolation isolation;
  isolation.command = {RASTERCHECK_BENCH_PROGRAM, "worker"};
  const auto backend = specification == "cpu"
                           ? backends::make_backend(specification)
                           : backends::make_isolated_backend(specification, isolation);
  if (!backend) return bench.SkipWithError(backend.error().reason.c_str());
  const std::vector<std::string> laws{std::string(properties::kCoverageLaw),
                                      std::string(properties::kValuesLaw)};
  records::SceneResult result;
  double drawing = 0;
  std::chrono::duration<double> all{0};
  for (auto _ : bench) {
    TimedBackend timed(**backend);
    const auto start = std::chrono::steady_clock::now();
    const auto found = properties::judge_scene(*scene, specification, timed, 1, laws, 2);
    all += std::chrono::steady_clock::now() - start;
    if (!found) return bench.SkipWithError(to_string(found.error()).c_str());
    if (found->result.judged == 0) {
      return bench.SkipWithError(records::scene_sentence(found->result).c_str());
    }
    result = found->result;
    drawing += timed.seconds();
  }
  const auto times = static_cast<double>(bench.iterations());
  bench.counters["fragments"] = static_cast<double>(result.fragments);
  bench.counters["judged_share"] =
      static_cast<double>(result.judged) / static_cast<double>(result.judged + result.open);
  bench.counters["wrong"] = static_cast<double>(result.wrong);
  bench.counters["seconds_drawing"] = drawing / times;
  bench.counters["seconds_judging"] = (all.count() - drawing) / times;
}

[[maybe_unused]] const bool kAreRegistered = [] {
  const std::string plugin = std::string("plugin:") + RASTERCHECK_BENCH_PLUGIN;
  const std::vector<std::pair<std::string, std::string>> backends{
      {"cpu", "cpu"},
      {"llvmpipe", "gl:llvmpipe"},
      {"softpipe", "gl:softpipe"},
      {"lavapipe", "vulkan:lavapipe"},
      {"swiftshader", "vulkan:swiftshader"},
      {"plugin", plugin}};
  for (const auto& [name, specification] : backends) {
    for (const std::string_view scene : kJudgedScenes) {
      benchmark::RegisterBenchmark(fmt::format("scene/{}/{}", name, scene).c_str(),
                                   [specification = specification, scene](benchmark::State& bench) {
                                     judge(bench, specification, scene);
                                   })
          ->Unit(benchmark::kSecond)
          ->UseRealTime()
          ->Iterations(1);
    }
  }
  return true;
}();

}  // namespace
}  // namespace rastercheck::bench
