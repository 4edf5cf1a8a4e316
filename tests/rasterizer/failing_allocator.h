#pragma once

// The allocation operators of this program, which can be made to fail. ThreadSanitizer has its own
// operators.

namespace rastercheck::rasterizer {

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define RASTERCHECK_HAS_TSAN
#endif
#endif

#ifdef RASTERCHECK_HAS_TSAN
inline constexpr bool kCanRunOutOfMemory = false;
#else
inline constexpr bool kCanRunOutOfMemory = true;
#endif

/// The number of allocations that still succeed; negative: all succeed.
extern int allocations_left;

/// Runs the call; only the first `count` allocations succeed.
template <class Call>
auto with_allocations(int count, Call call) {
  allocations_left = count;
  auto result = call();
  allocations_left = -1;
  return result;
}

}  // namespace rastercheck::rasterizer
