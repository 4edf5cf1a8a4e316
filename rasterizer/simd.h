#pragma once

// Which kind of vectors the kernels run on. By default it is the best that the processor has; the
// pictures are the same on all, to the bit.

#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace rastercheck::rasterizer {

/// A kind of vectors, by its name in small letters: "sse4", "avx2", "avx3" (AVX-512), …; "emu128"
/// and "scalar" are what every processor has.
struct SimdTarget {
  std::string name;
  bool is_compiled = false;   ///< whether the kernels are compiled for it
  bool is_supported = false;  ///< whether, besides, this processor has it
};

/// Those of this kind of processors, and those of all; the best first.
std::vector<SimdTarget> simd_targets();

/// While it is there, draws run on one kind of vectors. The choice is the whole process's: a draw
/// of another thread runs, meanwhile or from some point on, on the same vectors, and comes out the
/// same as ever. One waits for the other where two are made at once, so that a thread can have no
/// more than one.
class OnSimdTarget {
 public:
  /// Without a name, or with that of no target that is supported, nothing changes.
  explicit OnSimdTarget(std::string_view name);
  OnSimdTarget(const OnSimdTarget&) = delete;
  OnSimdTarget& operator=(const OnSimdTarget&) = delete;
  ~OnSimdTarget() noexcept(false);  // Highway does not say that choosing cannot fail

 private:
  std::unique_lock<std::mutex> lock_;  ///< held where something was changed
};

}  // namespace rastercheck::rasterizer
