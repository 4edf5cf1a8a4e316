// rastercheck-bench-vulkan: draws the benchmark's scenes through Vulkan for rastercheck-bench,
// which starts a new process for every configuration. RASTERCHECK_BENCH_DEVICE names the device, as
// after the colon of the backend `vulkan`. RASTERCHECK_BENCH_CORES is the number of cores that it
// may use; if not set, it may use all. The first answer comes unasked.
//
//   (started)     ok DESCRIPTION
//   scene NAME COLOR SAMPLES
//                 ok                 the scene is built, uploaded and drawn to warm up; COLOR is
//                                    rgba32f
//   draw COUNT    ok SECONDS         that many frames, each finished before the next
//   summary       ok COVERED RED GREEN DEPTH    of the last frame (summary.h)

#include <sched.h>

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/frame_scenes.h"
#include "tests/bench/peer_answers.h"
#include "tests/bench/summary.h"
#include "tests/bench/vulkan/frame.h"

namespace rastercheck::bench {
namespace {

namespace vulkan = backends::vulkan::bench;

tl::unexpected<Error> failure(const std::string& reason) {
  return tl::unexpected(Error{"", "", reason});
}

class VulkanPeer {
 public:
  explicit VulkanPeer(vulkan::Frame frame) : frame_(std::move(frame)) {}

  /// Returns the text that follows "ok ".
  Result<std::string> answer(const std::string& line) {
    std::istringstream words(line);
    std::string verb;
    words >> verb;
    if (verb == "scene") {
      std::string name;
      std::string color;
      std::string kind;
      int samples = 0;
      words >> name >> color >> samples >> kind;
      if (color != "rgba32f" || !kind.empty()) return failure("it draws plain frames in floats");
      return take(name, samples).map([] { return std::string(); });
    }
    if (verb == "draw") {
      int count = 0;
      words >> count;
      return draw(count);
    }
    if (verb == "summary") return summary();
    return failure("not understood: " + line);
  }

 private:
  Result<void> take(const std::string& name, int samples) {
    const Result<Scene>& scene = frame_scene(name);
    if (!scene) return tl::unexpected(scene.error());
    std::vector<cases::ClipVertex> positions;
    for (const glm::vec4& p : scene->positions) positions.push_back({p.x, p.y, p.z, p.w});
    std::vector<cases::Triangle> triangles;
    for (const glm::uvec3& t : scene->triangles) triangles.push_back({t.x, t.y, t.z});
    const Result<void> taken = frame_.take({positions, scene->attributes, triangles},
                                           {scene->size.x, scene->size.y, samples});
    if (!taken) return tl::unexpected(taken.error());
    // The first frame compiles shaders, and the second touches memory for the first time.
    return draw(2).map([](const std::string& /*seconds*/) {});
  }

  Result<std::string> draw(int count) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i) {
      if (const Result<void> drawn = frame_.draw(); !drawn) return tl::unexpected(drawn.error());
    }
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return text(taken.count());
  }

  Result<std::string> summary() {
    const Result<vulkan::FramePicture> picture = frame_.read();
    if (!picture) return tl::unexpected(picture.error());
    const Summary s = summarize(picture->depth, picture->color, 4);
    return text(s.covered, s.red, s.green, s.depth);
  }

  vulkan::Frame frame_;
};

/// Limits this process to that many cores. A driver that counts the machine's cores makes as many
/// threads all the same, which then take turns.
void keep_to_cores(int count) {
  cpu_set_t all;
  CPU_ZERO(&all);
  if (::sched_getaffinity(0, sizeof all, &all) != 0) return;
  cpu_set_t some;
  CPU_ZERO(&some);
  for (std::size_t i = 0; i < CPU_SETSIZE && CPU_COUNT(&some) < count; ++i) {
    if (CPU_ISSET(i, &all)) CPU_SET(i, &some);
  }
  ::sched_setaffinity(0, sizeof some, &some);
}

int serve_device() {
  if (const char* const cores = std::getenv("RASTERCHECK_BENCH_CORES"); cores != nullptr) {
    keep_to_cores(std::atoi(cores));
  }
  const char* const device = std::getenv("RASTERCHECK_BENCH_DEVICE");
  Result<vulkan::Frame> frame = vulkan::Frame::create(device == nullptr ? "" : device);
  if (!frame) {
    say(tl::unexpected(frame.error()));
    return 0;
  }
  say(frame->description());
  VulkanPeer peer(*std::move(frame));
  serve([&peer](const std::string& line) { return peer.answer(line); });
  return 0;
}

}  // namespace
}  // namespace rastercheck::bench

int main() { return rastercheck::bench::serve_device(); }
