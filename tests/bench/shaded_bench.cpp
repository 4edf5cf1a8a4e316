// raster/draw-KIND/threads:T/SCENE and raster/llvmpipe-KIND/threads:T/width:W/SCENE: whole frames,
// cleared and drawn through a shader, then blended and tested as the kinds in draw_kinds.h say.
// Both sides draw into four channels of bytes and float32 depth; with -float32 after the kind, into
// four floats. Pixels of both pictures are compared before llvmpipe is timed.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "backends/cpu/case_state.h"
#include "rasterizer/shading.h"
#include "rasterizer/texture.h"
#include "tests/bench/draw_kinds.h"
#include "tests/bench/driver_peer.h"
#include "tests/bench/frame_timing.h"
#include "tests/bench/probes.h"
#include "tests/bench/texture_scenes.h"

namespace rastercheck::bench {
namespace {

using rasterizer::ColorFormat;

/// A shader that outputs both attributes as red and green, blue 0, and this alpha.
struct ColorShader {
  float alpha = 1;

  std::size_t outputs() const { return 4; }
  bool discards() const { return false; }
  void operator()(const rasterizer::FragmentBatch& in, rasterizer::ShadedBatch& out) const {
    for (std::size_t channel = 0; channel < 2; ++channel) {
      rasterizer::round_values(in, channel, out.color[channel]);
    }
    std::fill_n(out.color[2], in.lanes, 0.0F);
    std::fill_n(out.color[3], in.lanes, alpha);
  }
};

rasterizer::State state_of(const DrawKind& kind, const Scene& scene) {
  rasterizer::State state;
  state.viewport.size = scene.size;
  state.attributes.resize(2);
  state.depth_test = backends::depth_test(kind.depth_function);
  state.depth_write = kind.writes_depth;
  state.blend = backends::blend(kind.blend);
  return state;
}

/// Draws a frame. Returns the problem in one line; empty if the frame was drawn.
std::string draw_frame(const DrawKind& kind, const Scene& scene, rasterizer::Picture& framebuffer,
                       unsigned threads) {
  const rasterizer::State state = state_of(kind, scene);
  const rasterizer::TargetSize size{scene.size.x, scene.size.y, 1};
  const auto draw_by = [&](const auto& shader) {
    const auto error = rasterizer::clear_and_draw(state, scene.mesh(), shader, size,
                                                  kind.clear_depth, framebuffer, threads)
                           .error;
    return error ? std::string(rasterizer::to_string(*error)) : std::string();
  };
  if (!kind.filter) return draw_by(ColorShader{kind.alpha});
  const Result<rasterizer::Texture>& texture = bench_texture();
  if (!texture) return to_string(texture.error());
  return draw_by(rasterizer::TexturedShader{.texture = &*texture,
                                            .sampler = {.filter = backends::filter(*kind.filter)},
                                            .discard_below = kind.discard_below});
}

/// The allowed difference of llvmpipe's pixels from ours.
ExpectedProbes expectation(const DrawKind& kind) {
  ExpectedProbes expected;
  // Both sides round to bytes, and llvmpipe has eight bits for some weights and for blending: 2/255
  // together. llvmpipe's level of detail is one that GL allows, up to half a level from ours. In
  // most places, the texture's levels differ too little for that to matter, so 4/255 is enough. A
  // frame that was filtered bilinearly still fails, because it differs by more than 4/255 in more
  // than the allowed share of pixels.
  const bool has_levels = kind.filter == cases::Filter::trilinear;
  expected.tolerance = has_levels ? 4 : 2;
  // These are pixels at edges of triangles and of texels, where one side snaps and the other does
  // not.
  expected.share_apart = has_levels ? 0.03 : 0.01;
  return expected;
}

/// The probes of our picture, drawn on first request.
const Result<ExpectedProbes>& expected_probes(const DrawKind& kind, const std::string& name,
                                              const Scene& scene, ColorFormat format) {
  static std::map<std::tuple<std::string_view, std::string, ColorFormat>, Result<ExpectedProbes>>
      drawn;
  const std::tuple key{kind.name, name, format};
  const auto known = drawn.find(key);
  if (known != drawn.end()) return known->second;
  rasterizer::Picture framebuffer;
  framebuffer.format = format;
  if (const std::string problem = draw_frame(kind, scene, framebuffer, 1); !problem.empty()) {
    return drawn.emplace(key, tl::unexpected(Error{"", "", problem})).first->second;
  }
  ExpectedProbes expected = expectation(kind);
  expected.probes = take_probes(scene.size, framebuffer.depth, [&](std::size_t pixel) {
    std::array<float, 4> color{};
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const std::size_t at = 4 * pixel + channel;
      color[channel] = format == ColorFormat::rgba8
                           ? static_cast<float>(framebuffer.bytes[at]) / 255
                           : framebuffer.attributes[at];
    }
    return color;
  });
  return drawn.emplace(key, std::move(expected)).first->second;
}

void draw(benchmark::State& bench, const std::string& name, const DrawKind& kind,
          ColorFormat format, unsigned threads) {
  const Result<Scene>& scene = shaded_scene(name, kind);
  if (!scene) return bench.SkipWithError(to_string(scene.error()).c_str());
  rasterizer::Picture framebuffer;
  framebuffer.format = format;
  for (auto _ : bench) {
    if (const std::string problem = draw_frame(kind, *scene, framebuffer, threads);
        !problem.empty()) {
      return bench.SkipWithError(problem.c_str());
    }
    benchmark::DoNotOptimize(framebuffer.depth.data());
  }
  set_rates(bench, name);
}

void draw_by_llvmpipe(benchmark::State& bench, const std::string& name, const DrawKind& kind,
                      ColorFormat format, const Configuration& configuration) {
  const Result<Scene>& scene = shaded_scene(name, kind);
  if (!scene) return bench.SkipWithError(to_string(scene.error()).c_str());
  const Result<ExpectedProbes>& expected = expected_probes(kind, name, *scene, format);
  if (!expected) return bench.SkipWithError(to_string(expected.error()).c_str());
  DriverPeer& peer = driver_peer(configuration);
  const PeerTarget target{.color = format == ColorFormat::rgba8 ? "rgba8" : "rgba32f",
                          .kind = std::string(kind.name)};
  if (const Result<void> ready = peer.take(name, target, *expected); !ready) {
    return bench.SkipWithError(("no llvmpipe: " + to_string(ready.error())).c_str());
  }
  time_frames_of(peer, bench, name);
}

void add(const std::string& name, const DrawKind& kind, ColorFormat format) {
  const std::string what =
      std::string(kind.name) + (format == ColorFormat::float32 ? "-float32" : "");
  for (const unsigned threads : {1U, 2U}) {
    benchmark::RegisterBenchmark(
        fmt::format("raster/draw-{}/threads:{}/{}", what, threads, name).c_str(),
        [=, &kind](benchmark::State& bench) { draw(bench, name, kind, format, threads); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  for (const Configuration& configuration : llvmpipe_configurations()) {
    benchmark::RegisterBenchmark(
        fmt::format("raster/llvmpipe-{}/{}/{}", what, configuration.name, name).c_str(),
        [=, &kind](benchmark::State& bench) {
          draw_by_llvmpipe(bench, name, kind, format, configuration);
        })
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime();
  }
}

const bool kRegistered = [] {
  for (const std::string name : {"fill_32_layers", "random_8px", "random_72px", "bunny"}) {
    for (const DrawKind& kind : kDrawKinds) {
      add(name, kind, ColorFormat::rgba8);
      const bool in_floats_too = kind.name == "textured-bilinear" || kind.name == "blended-over";
      if (in_floats_too) add(name, kind, ColorFormat::float32);
    }
  }
  return true;
}();

}  // namespace
}  // namespace rastercheck::bench
