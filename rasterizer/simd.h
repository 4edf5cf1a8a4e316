#pragma once

// Chooses the SIMD target that the kernels run on. The default is the best target that the
// processor supports. Pictures are identical, to the bit, on all targets.

#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::rasterizer {

/// A SIMD target, by its lower-case name: "sse4", "avx2", "avx3" (AVX-512), …. Every processor
/// supports "emu128" and "scalar".
struct SimdTarget {
  std::string name;
  bool is_compiled = false;   ///< true if the kernels are compiled for this target
  bool is_supported = false;  ///< true if this processor also supports it
};

/// Returns the targets of this processor architecture and the portable targets, best first.
std::vector<SimdTarget> simd_targets();

/// Makes draws run on one SIMD target while the object exists. The choice applies to the whole
/// process: draws of other threads use the same target, from now or from some later point on, with
/// unchanged results. A second object waits until the first is destroyed, so no thread may hold
/// two.
class OnSimdTarget {
 public:
  /// Changes nothing if `name` is empty or does not name a supported target.
  explicit OnSimdTarget(std::string_view name);
  OnSimdTarget(const OnSimdTarget&) = delete;
  OnSimdTarget& operator=(const OnSimdTarget&) = delete;
  ~OnSimdTarget() noexcept(false);  // Highway does not promise that choosing cannot fail

 private:
  std::unique_lock<std::mutex> lock_;  ///< held if the constructor changed the target
};

}  // namespace rastercheck::rasterizer
