#pragma once

// The allocations of this program, which can be made to fail. ThreadSanitizer has operators of its
// own.

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

/// How many allocations still succeed; negative: all.
extern int allocations_left;

/// Runs the call with `count` allocations to spare.
template <class Call>
auto with_allocations(int count, Call call) {
  allocations_left = count;
  auto result = call();
  allocations_left = -1;
  return result;
}

}  // namespace rastercheck::rasterizer
