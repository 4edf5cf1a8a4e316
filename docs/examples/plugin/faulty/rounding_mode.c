/*
 * Leaves the processor rounding towards zero.
 *
 * RasterCheck: “draw() changed the rounding mode”
 */
#include <fenv.h>

#include "faulty.h"

static uint32_t faulty_draw(const rastercheck_draw* draw, rastercheck_output* out) {
  const uint32_t result = draw_all(draw, out);
  fesetround(FE_TOWARDZERO);
  return result;
}

const rastercheck_plugin* rastercheck_plugin_get(void) { return little_with_draw(faulty_draw); }
