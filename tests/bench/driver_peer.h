#pragma once

// Software drivers to compare with: Mesa's llvmpipe, the fastest there is, through OpenGL, and its
// sister lavapipe and SwiftShader through Vulkan. A process for each configuration, as drivers read
// their settings from the environment once.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/error.h"
#include "tests/bench/peer_process.h"
#include "tests/bench/probes.h"
#include "tests/bench/summary.h"

namespace rastercheck::bench {

/// What a driver draws into, beside a depth of float32.
struct PeerTarget {
  std::string color = "rgba32f";  ///< or "rgba8"
  int samples = 1;
  std::string kind = {};  ///< how (draw_kinds.h); empty: attributes as colours where depth is less
};

/// Pixels of a shaded picture, and how far another's may be from them.
struct ExpectedProbes {
  Probes probes;
  int tolerance = 0;       ///< in 1/255
  double share_apart = 0;  ///< of pixels that may be further away
};

/// A driver, and how its process is started.
struct Configuration {
  std::string driver;                 ///< "llvmpipe"
  std::string name;                   ///< what it is called in a benchmark: "threads:1"
  std::string program;                ///< gl_peer.cpp or vulkan_peer.cpp
  std::vector<std::string> settings;  ///< of the environment
  double covered_tolerance = 0.01;    ///< share of covered pixels (show_the_same())
};

class DriverPeer {
 public:
  explicit DriverPeer(const Configuration& configuration);

  const std::string& renderer() const { return renderer_; }

  /// Makes it ready to draw this scene; an error where its picture is another than the `expected`.
  Result<void> take(const std::string& scene, const PeerTarget& target, const Summary& expected);
  Result<void> take(const std::string& scene, const PeerTarget& target,
                    const ExpectedProbes& expected);

  /// Seconds for one frame.
  Result<double> draw();

 private:
  /// `check`: nothing where its answer to `question` is as expected, else what is not.
  Result<void> take(const std::string& scene, const PeerTarget& target, const char* question,
                    const std::function<std::string(const std::string& answer)>& check);

  double covered_tolerance_;
  std::unique_ptr<PeerProcess> process_;
  Error problem_;
  std::string renderer_;
  std::string taken_;  ///< the last request, empty: it did not succeed
};

/// Threads and vectors of llvmpipe.
///
/// LP_NUM_THREADS=N makes N threads that rasterize beside the one that calls, which transforms,
/// sets up and bins; with 0 that one does it all. So `threads:1` is 0, the one setting that keeps
/// to a core, and `threads:2` is 2, which leaves it at least the two cores that ours has: a draw is
/// binned before it is rasterized, so that the third thread waits most of the time. `width` is that
/// of its vectors in bits (LP_NATIVE_VECTOR_WIDTH); by default 256 where there is AVX.
std::vector<Configuration> llvmpipe_configurations();

/// lavapipe, which has llvmpipe's threads, and SwiftShader, which has as many as there are cores
/// that it may run on, and is held to `threads:T` of them. Both with their default vectors.
std::vector<Configuration> vulkan_configurations();

/// The process of a configuration: started when it is asked for first, ended with this one.
DriverPeer& driver_peer(const Configuration& configuration);

}  // namespace rastercheck::bench
