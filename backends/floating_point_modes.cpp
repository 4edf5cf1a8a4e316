#include "backends/floating_point_modes.h"

#include <cfenv>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace rastercheck::backends {
namespace {

#if defined(__SSE__)
unsigned control_register() { return _mm_getcsr(); }
void set_control_register(unsigned control) { _mm_setcsr(control); }
#else
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
  // Rounding (bits 13 and 14), flush to zero (15), denormals are zero (6). The other bits are
  // exception masks and sticky flags, which do not change results.
  constexpr unsigned kModes = 0xe040;
  return std::fegetround() != rounding_ || ((control_register() ^ control_) & kModes) != 0;
}

}  // namespace rastercheck::backends
