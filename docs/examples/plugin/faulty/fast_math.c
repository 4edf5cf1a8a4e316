/*
 * Has subnormal numbers flushed to zero when it is loaded, as programs do that GCC links with
 * -ffast-math. On processors other than x86 it only changes the rounding mode.
 *
 * RasterCheck: “loading it changes the rounding mode or the treatment of subnormal numbers; link
 * it without -ffast-math”
 */
#include <fenv.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "faulty.h"

__attribute__((constructor)) static void set_modes(void) {
#if defined(__SSE__)
  _mm_setcsr(_mm_getcsr() | 0x8040);
#else
  fesetround(FE_DOWNWARD);
#endif
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_get(); }
