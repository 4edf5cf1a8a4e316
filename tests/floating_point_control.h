#pragma once

#include <array>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace rastercheck {

/// The register with the floating-point modes of this thread, and what its bits mean: MXCSR on x86,
/// FPCR on arm64. `kFlushes` has each bit by which subnormal numbers count as zero, `kSticky` the
/// flags that calculations set.
#if defined(__SSE__)
inline constexpr std::array<unsigned, 2> kFlushes{0x8000, 0x0040};  // FTZ, DAZ
inline constexpr unsigned kSticky = 0x003f;
inline unsigned floating_point_control() { return _mm_getcsr(); }
inline void set_floating_point_control(unsigned control) { _mm_setcsr(control); }
#elif defined(__aarch64__)
inline constexpr std::array<unsigned, 1> kFlushes{0x01000000};  // FZ
inline constexpr unsigned kSticky = 0;                          // they are in FPSR
inline unsigned floating_point_control() {
  unsigned long long control = 0;
  asm volatile("mrs %0, fpcr" : "=r"(control));
  return static_cast<unsigned>(control);
}
inline void set_floating_point_control(unsigned control) {
  asm volatile("msr fpcr, %0" : : "r"(static_cast<unsigned long long>(control)));
}
#endif

}  // namespace rastercheck
