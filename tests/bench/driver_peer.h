#pragma once

// Software drivers to compare with: Mesa's llvmpipe, the fastest one, through OpenGL, and its
// sister lavapipe and SwiftShader through Vulkan. Each configuration has a process of its own, as
// drivers read their settings from the environment only once.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/error.h"
#include "tests/bench/peer_process.h"
#include "tests/bench/probes.h"
#include "tests/bench/summary.h"

namespace rastercheck::bench {

/// The target that a driver draws into, in addition to a depth buffer of float32.
struct PeerTarget {
  std::string color = "rgba32f";  ///< "rgba32f" or "rgba8"
  int samples = 1;
  std::string kind = {};  ///< from draw_kinds.h; empty: attributes as colours where depth is less
};

/// Pixels of a shaded picture, and the allowed difference of another picture's pixels.
struct ExpectedProbes {
  Probes probes;
  int tolerance = 0;       ///< in 1/255
  double share_apart = 0;  ///< share of pixels that may differ by more
};

/// A driver, and how to start its process.
struct Configuration {
  std::string driver;                 ///< such as "llvmpipe"
  std::string name;                   ///< as in benchmarks' names, such as "threads:1"
  std::string program;                ///< of gl_peer.cpp or vulkan_peer.cpp
  std::vector<std::string> settings;  ///< environment variables
  double covered_tolerance = 0.01;    ///< share of covered pixels (show_the_same())
};

class DriverPeer {
 public:
  explicit DriverPeer(const Configuration& configuration);

  const std::string& renderer() const { return renderer_; }

  /// Makes the driver ready to draw this scene. Fails if its picture differs from `expected`.
  Result<void> take(const std::string& scene, const PeerTarget& target, const Summary& expected);
  Result<void> take(const std::string& scene, const PeerTarget& target,
                    const ExpectedProbes& expected);

  /// Draws one frame and returns the seconds it took.
  Result<double> draw();

 private:
  /// `check` takes the driver's answer to `question`. It returns nothing if the answer is as
  /// expected, or else says what is wrong.
  Result<void> take(const std::string& scene, const PeerTarget& target, const char* question,
                    const std::function<std::string(const std::string& answer)>& check);

  double covered_tolerance_;
  std::unique_ptr<PeerProcess> process_;
  Error problem_;
  std::string renderer_;
  std::string taken_;  ///< the last request; empty if it failed
};

/// The configurations of llvmpipe, with the number of its threads and the width of its vectors.
///
/// LP_NUM_THREADS=N makes N threads that rasterize, beside the calling thread, which transforms,
/// sets up and bins. With N = 0, the calling thread does everything. So `threads:1` sets 0, the
/// only value that uses a single core. `threads:2` sets 2, which gives llvmpipe at least the two
/// cores that ours has: a draw is binned before it is rasterized, so the third thread waits most of
/// the time. `width` is that of the vectors in bits (LP_NATIVE_VECTOR_WIDTH); the default is 256 if
/// AVX is available.
std::vector<Configuration> llvmpipe_configurations();

/// The configurations of lavapipe, whose threads are set like llvmpipe's, and of SwiftShader, which
/// makes one thread per core that it may use, and is therefore limited to T cores for `threads:T`.
/// Both use their default vectors.
std::vector<Configuration> vulkan_configurations();

/// The process of a configuration. It is started on first request, and ends with this process.
DriverPeer& driver_peer(const Configuration& configuration);

}  // namespace rastercheck::bench
