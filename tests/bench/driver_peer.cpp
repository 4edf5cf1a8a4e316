#include "tests/bench/driver_peer.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <sstream>
#include <utility>

namespace rastercheck::bench {
namespace {

/// The T of `threads:T`, and the value of LP_NUM_THREADS for llvmpipe and lavapipe.
constexpr std::array<std::pair<const char*, const char*>, 2> kThreads{{{"1", "0"}, {"2", "2"}}};

/// The tolerance for SwiftShader's number of covered pixels. Its grid of 2^-4 pixels makes it cover
/// up to 4% more if triangles are as small as a pixel.
constexpr double kCoarseGrid = 0.05;

}  // namespace

DriverPeer::DriverPeer(const Configuration& configuration)
    : covered_tolerance_(configuration.covered_tolerance) {
  Result<std::unique_ptr<PeerProcess>> started =
      PeerProcess::start(configuration.program, configuration.settings);
  if (!started) {
    problem_ = started.error();
    return;
  }
  const Result<std::string> renderer = (*started)->hear();
  if (!renderer) {
    problem_ = renderer.error();
  } else if (renderer->find(configuration.driver) == std::string::npos) {
    problem_ = Error{"", "", "it is not " + configuration.driver + " that draws but " + *renderer};
  } else {
    renderer_ = *renderer;
    process_ = *std::move(started);
  }
}

Result<void> DriverPeer::take(const std::string& scene, const PeerTarget& target,
                              const Summary& expected) {
  return take(scene, target, "summary", [&](const std::string& answer) {
    Summary its;
    std::istringstream(answer) >> its.covered >> its.red >> its.green >> its.depth;
    return show_the_same(its, expected, covered_tolerance_) ? std::string() : answer;
  });
}

Result<void> DriverPeer::take(const std::string& scene, const PeerTarget& target,
                              const ExpectedProbes& expected) {
  return take(scene, target, "probes", [&](const std::string& answer) {
    const double share = share_apart(from_word(answer), expected.probes, expected.tolerance);
    return share <= expected.share_apart
               ? std::string()
               : fmt::format("{:.2g} of its pixels are off by more than {}/255", share,
                             expected.tolerance);
  });
}

Result<void> DriverPeer::take(const std::string& scene, const PeerTarget& target,
                              const char* question,
                              const std::function<std::string(const std::string& answer)>& check) {
  if (!process_) return tl::unexpected(problem_);
  std::string request = fmt::format("scene {} {} {}", scene, target.color, target.samples);
  if (!target.kind.empty()) request += " " + target.kind;
  if (taken_ == request) return {};
  taken_.clear();
  const Result<std::string> answer = process_->ask(request).and_then(
      [&](const std::string& /*ok*/) { return process_->ask(question); });
  if (!answer) return tl::unexpected(answer.error());
  if (const std::string other = check(*answer); !other.empty()) {
    return tl::unexpected(Error{"", "", "its picture of " + scene + " is another: " + other});
  }
  taken_ = request;
  return {};
}

Result<double> DriverPeer::draw() {
  return process_->ask("draw 1").map([](const std::string& seconds) { return std::stod(seconds); });
}

std::vector<Configuration> llvmpipe_configurations() {
  std::vector<Configuration> all;
  for (const auto& [threads, lp_num_threads] : kThreads) {
    for (const auto& [width, setting] :
         {std::pair{"default", "LP_NATIVE_VECTOR_WIDTH"}, {"512", "LP_NATIVE_VECTOR_WIDTH=512"}}) {
      all.push_back({"llvmpipe",
                     fmt::format("threads:{}/width:{}", threads, width),
                     RASTERCHECK_BENCH_GL_PROGRAM,
                     {"LIBGL_ALWAYS_SOFTWARE=1", "GALLIUM_DRIVER=llvmpipe",
                      fmt::format("LP_NUM_THREADS={}", lp_num_threads), setting}});
    }
  }
  return all;
}

std::vector<Configuration> vulkan_configurations() {
  std::vector<Configuration> all;
  for (const auto& [threads, lp_num_threads] : kThreads) {
    const std::string name = fmt::format("threads:{}", threads);
    all.push_back({"lavapipe",
                   name,
                   RASTERCHECK_BENCH_VULKAN_PROGRAM,
                   {"RASTERCHECK_BENCH_DEVICE=lavapipe", "LP_NATIVE_VECTOR_WIDTH",
                    "RASTERCHECK_BENCH_CORES", fmt::format("LP_NUM_THREADS={}", lp_num_threads)}});
    all.push_back({"swiftshader",
                   name,
                   RASTERCHECK_BENCH_VULKAN_PROGRAM,
                   {"RASTERCHECK_BENCH_DEVICE=swiftshader",
                    fmt::format("RASTERCHECK_BENCH_CORES={}", threads)},
                   kCoarseGrid});
  }
  return all;
}

DriverPeer& driver_peer(const Configuration& configuration) {
  static std::map<std::string, DriverPeer> all;
  return all.try_emplace(configuration.driver + "/" + configuration.name, configuration)
      .first->second;
}

}  // namespace rastercheck::bench
