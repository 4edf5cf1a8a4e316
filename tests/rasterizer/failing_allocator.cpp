#include "tests/rasterizer/failing_allocator.h"

#include <cstdlib>
#include <new>

namespace rastercheck::rasterizer {

int allocations_left = -1;

#ifndef RASTERCHECK_HAS_TSAN
static void take_allocation() {
  if (allocations_left == 0) throw std::bad_alloc();
  if (allocations_left > 0) --allocations_left;
}
#endif

}  // namespace rastercheck::rasterizer

#ifndef RASTERCHECK_HAS_TSAN
// If GCC inlines only one of a pair of operators, it reports malloc and free as a mismatch.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif
// Allocates exactly the number of bytes asked for, so that AddressSanitizer detects accesses beyond
// them.
void* operator new(std::size_t size) {
  rastercheck::rasterizer::take_allocation();
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  rastercheck::rasterizer::take_allocation();
  void* memory = nullptr;
  const auto unit = static_cast<std::size_t>(alignment);
  if (posix_memalign(&memory, unit, size == 0 ? 1 : size) == 0) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
#endif
