#include "backends/floating_point_modes.h"

#include <cfenv>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace rastercheck::backends {
namespace {

// The bits that change which number an operation gives.
#if defined(__SSE__)
// MXCSR: rounding (bits 13 and 14), flush to zero (15), denormals are zero (6). The others are
// exception masks and sticky flags.
constexpr unsigned kModes = 0xe040;
unsigned control_register() { return _mm_getcsr(); }
void set_control_register(unsigned control) { _mm_setcsr(control); }
#elif defined(__aarch64__)
// FPCR: rounding (bits 22 and 23), flush to zero (24), and what newer cores have: flushed operands
// (0) and another meaning of bit 24 (1), both 0 on older ones. Bits 32 and above are reserved.
constexpr unsigned kModes = 0x01c00003;
unsigned control_register() {
  unsigned long long control = 0;
  asm volatile("mrs %0, fpcr" : "=r"(control));
  return static_cast<unsigned>(control);
}
void set_control_register(unsigned control) {
  asm volatile("msr fpcr, %0" : : "r"(static_cast<unsigned long long>(control)));
}
#else
constexpr unsigned kModes = 0;
unsigned control_register() { return 0; }
void set_control_register(unsigned /*control*/) {}
#endif

}  // namespace

FloatingPointModes::FloatingPointModes()
    : rounding_(std::fegetround()), control_(control_register()) {}

FloatingPointModes::~FloatingPointModes() {
  std::fesetround(rounding_);
  set_control_register(control_);
}

bool FloatingPointModes::have_changed() const {
  return std::fegetround() != rounding_ || ((control_register() ^ control_) & kModes) != 0;
}

}  // namespace rastercheck::backends
