// raster/draw/… and raster/llvmpipe/…: whole frames, cleared and drawn with a depth test, two
// perspective attributes in float32, 1024×1024. Ours by `draw`; Mesa's llvmpipe, the fastest
// software driver there is to compare with, through OpenGL into RGBA32F and depth32F, in the same
// run, by a process for each configuration: llvmpipe reads its settings from the environment once.
//
// llvmpipe's threads. LP_NUM_THREADS=N makes N threads that rasterize beside the one that calls,
// which transforms, sets up and bins; with 0 that one does it all. So `threads:1` is 0, the one
// setting that keeps to a core, and `threads:2` is 2, which leaves it at least the two cores that
// ours has: a draw is binned before it is rasterized, so that the third thread waits most of the
// time. `width` is that of its vectors in bits (LP_NATIVE_VECTOR_WIDTH); by default 256 where there
// is AVX.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "tests/bench/bench_scenes.h"
#include "tests/bench/peer_process.h"
#include "tests/bench/summary.h"

namespace rastercheck::bench {
namespace {

/// A scene and what our rasterizer makes of it; made when it is asked for first.
struct Frame {
  Scene scene;
  Summary summary;
};

rasterizer::State frame_state() {
  rasterizer::State state;
  state.viewport.size = {kTarget, kTarget};
  state.attributes.resize(2);
  state.depth_test = rasterizer::DepthTest::less;
  return state;
}

/// Whether it could be drawn.
bool draw_frame(const rasterizer::State& state, const Scene& scene,
                rasterizer::Framebuffer& framebuffer, unsigned threads = 1) {
  return !rasterizer::clear(framebuffer, {kTarget, kTarget, 1}, 2, 1) &&
         !rasterizer::draw(state, scene.mesh(), framebuffer, threads).error;
}

const Result<Frame>& frame_of(const std::string& name) {
  static std::map<std::string, Result<Frame>> frames;
  const auto known = frames.find(name);
  if (known != frames.end()) return known->second;
  Result<Frame> made = frame_scene(name).and_then([](const Scene& scene) -> Result<Frame> {
    rasterizer::Framebuffer drawn;
    if (!draw_frame(frame_state(), scene, drawn)) {
      return tl::unexpected(Error{"", "", "the draw was refused"});
    }
    return Frame{scene, summarize(drawn.depth, drawn.attributes, 2)};
  });
  return frames.emplace(name, std::move(made)).first->second;
}

void set_rates(benchmark::State& bench, const Scene& scene) {
  const auto rate = [&bench](double count) {
    return benchmark::Counter(count * static_cast<double>(bench.iterations()),
                              benchmark::Counter::kIsRate);
  };
  bench.counters["triangles_per_second"] = rate(static_cast<double>(scene.triangles.size()));
  // Hidden ones too: all of them in fill_32_layers are shaded.
  bench.counters["pixels_per_second"] = rate(drawn_area(scene));
}

void draw(benchmark::State& bench, const std::string& name, unsigned threads) {
  const Result<Frame>& frame = frame_of(name);
  if (!frame) return bench.SkipWithError(to_string(frame.error()).c_str());
  const rasterizer::State state = frame_state();
  rasterizer::Framebuffer framebuffer;
  for (auto _ : bench) {
    if (!draw_frame(state, frame->scene, framebuffer, threads))
      return bench.SkipWithError("refused");
    benchmark::DoNotOptimize(framebuffer.depth.data());
  }
  set_rates(bench, frame->scene);
}

/// A process that draws by llvmpipe, and the scene it has drawn last.
class Llvmpipe {
 public:
  explicit Llvmpipe(const std::vector<std::string>& settings) {
    Result<std::unique_ptr<PeerProcess>> started =
        PeerProcess::start(RASTERCHECK_BENCH_GL_PROGRAM, settings);
    if (!started) {
      problem_ = started.error();
      return;
    }
    const Result<std::string> renderer = (*started)->hear();
    if (!renderer) {
      problem_ = renderer.error();
    } else if (!renderer->starts_with("llvmpipe")) {
      problem_ = Error{"", "", "it is not llvmpipe that draws but " + *renderer};
    } else {
      renderer_ = *renderer;
      process_ = *std::move(started);
    }
  }

  const std::string& renderer() const { return renderer_; }

  /// Makes it ready to draw this frame; an error where it draws something else than we do.
  Result<void> take(const std::string& name, const Frame& frame) {
    if (!process_) return tl::unexpected(problem_);
    if (scene_ == name) return {};
    scene_.clear();
    const Result<std::string> summary =
        process_->ask("scene " + name).and_then([&](const std::string& /*ok*/) {
          return process_->ask("summary");
        });
    if (!summary) return tl::unexpected(summary.error());
    Summary its;
    std::istringstream(*summary) >> its.covered >> its.red >> its.green >> its.depth;
    if (!show_the_same(its, frame.summary)) {
      return tl::unexpected(Error{"", "", "its picture of " + name + " is another: " + *summary});
    }
    scene_ = name;
    return {};
  }

  /// Seconds for one frame.
  Result<double> draw() {
    return process_->ask("draw 1").map(
        [](const std::string& seconds) { return std::stod(seconds); });
  }

 private:
  std::unique_ptr<PeerProcess> process_;
  Error problem_;
  std::string renderer_;
  std::string scene_;
};

struct Configuration {
  std::string name;
  std::vector<std::string> settings;
};

/// The process of a configuration: started when it is asked for first, ended with this one.
Llvmpipe& llvmpipe(const Configuration& configuration) {
  static std::map<std::string, Llvmpipe> all;
  return all.try_emplace(configuration.name, configuration.settings).first->second;
}

void draw_by_llvmpipe(benchmark::State& bench, const std::string& name,
                      const Configuration& configuration) {
  const Result<Frame>& frame = frame_of(name);
  if (!frame) return bench.SkipWithError(to_string(frame.error()).c_str());
  Llvmpipe& peer = llvmpipe(configuration);
  if (const Result<void> ready = peer.take(name, *frame); !ready) {
    return bench.SkipWithError(("no llvmpipe: " + to_string(ready.error())).c_str());
  }
  for (auto _ : bench) {
    const Result<double> seconds = peer.draw();
    if (!seconds) return bench.SkipWithError(to_string(seconds.error()).c_str());
    bench.SetIterationTime(*seconds);
  }
  bench.SetLabel(peer.renderer());
  set_rates(bench, frame->scene);
}

std::vector<Configuration> configurations() {
  std::vector<Configuration> all;
  for (const auto& [threads, lp_num_threads] : {std::pair{"1", "0"}, std::pair{"2", "2"}}) {
    for (const auto& [width, setting] :
         {std::pair{"default", "LP_NATIVE_VECTOR_WIDTH"}, {"512", "LP_NATIVE_VECTOR_WIDTH=512"}}) {
      all.push_back({fmt::format("threads:{}/width:{}", threads, width),
                     {"LIBGL_ALWAYS_SOFTWARE=1", "GALLIUM_DRIVER=llvmpipe",
                      fmt::format("LP_NUM_THREADS={}", lp_num_threads), setting}});
    }
  }
  return all;
}

const bool kRegistered = [] {
  for (const std::string_view scene : frame_scenes()) {
    const std::string name(scene);
    for (const unsigned threads : {1U, 2U}) {
      benchmark::RegisterBenchmark(fmt::format("raster/draw/threads:{}/{}", threads, name).c_str(),
                                   [=](benchmark::State& bench) { draw(bench, name, threads); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
    for (const Configuration& configuration : configurations()) {
      benchmark::RegisterBenchmark(
          ("raster/llvmpipe/" + configuration.name + "/" + name).c_str(),
          [=](benchmark::State& bench) { draw_by_llvmpipe(bench, name, configuration); })
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
    }
  }
  return true;
}();

}  // namespace
}  // namespace rastercheck::bench
