#include "tests/bench/llvmpipe.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

namespace rastercheck::bench {

Llvmpipe::Llvmpipe(const std::vector<std::string>& settings) {
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

Result<void> Llvmpipe::take(const std::string& scene, const PeerTarget& target,
                            const Summary& expected) {
  return take(scene, target, "summary", [&](const std::string& answer) {
    Summary its;
    std::istringstream(answer) >> its.covered >> its.red >> its.green >> its.depth;
    return show_the_same(its, expected) ? std::string() : answer;
  });
}

Result<void> Llvmpipe::take(const std::string& scene, const PeerTarget& target,
                            const ExpectedProbes& expected) {
  return take(scene, target, "probes", [&](const std::string& answer) {
    const double share = share_apart(from_word(answer), expected.probes, expected.tolerance);
    return share <= expected.share_apart
               ? std::string()
               : fmt::format("{:.2g} of its pixels are off by more than {}/255", share,
                             expected.tolerance);
  });
}

Result<void> Llvmpipe::take(const std::string& scene, const PeerTarget& target,
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

Result<double> Llvmpipe::draw() {
  return process_->ask("draw 1").map([](const std::string& seconds) { return std::stod(seconds); });
}

std::vector<Configuration> llvmpipe_configurations() {
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

Llvmpipe& llvmpipe(const Configuration& configuration) {
  static std::map<std::string, Llvmpipe> all;
  return all.try_emplace(configuration.name, configuration.settings).first->second;
}

}  // namespace rastercheck::bench
